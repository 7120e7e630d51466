//! The page that shows a scene while it is edited, and the server of it.
//!
//! HTTP gives the files of the page, which are in the program, and the picture as PNG or EXR. Nothing is read from the disk for a request.
//! The rest goes through one WebSocket: the server says what changed, the page asks for pictures, one at a time.

mod excerpt;
mod frame;
mod guard;
mod message;
mod page;
mod socket;

use super::{Event, Live, Show};
use crate::film::{self, Format};
use crate::{Error, Result};
use axum::Router;
use axum::extract::{Path, Request, State, WebSocketUpgrade};
use axum::http::{HeaderMap, StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use guard::{Asked, Guard};
use message::{Now, Saying};
use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use tokio::net::TcpListener;
use tokio::sync::oneshot;

/// Where a page is served.
#[derive(Debug, Clone)]
pub struct Address {
    /// Of this machine alone, unless it is another than a loopback address.
    pub host: IpAddr,
    /// 0 = any that is free.
    pub port: u16,
}

/// What pages are told.
pub struct About {
    /// Name of the device.
    pub device: String,
    /// Samples after which a picture is done.
    pub spp: u32,
    /// Folders of which lines may be shown beside errors.
    pub roots: Vec<PathBuf>,
}

/// A server. It ends when this is dropped.
pub struct Server {
    url: String,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// What all requests share.
struct Desk {
    show: Arc<Show>,
    events: Mutex<Sender<Event>>,
    guard: Guard,
    about: About,
}

impl Desk {
    fn tell(&self, event: Event) {
        // Nobody is left to hear it only while all ends
        _ = self.events.lock().unwrap_or_else(PoisonError::into_inner).send(event);
    }

    fn state(&self) -> Saying {
        let About { device, spp, roots } = &self.about;
        Saying::State(Box::new(Now::of(&self.show.state(), device, *spp, roots)))
    }
}

impl Server {
    /// Serves the page of a scene, on a thread of its own.
    ///
    /// # Errors
    ///
    /// When the address is taken or not of this machine.
    pub fn start(live: &Live, address: &Address, mut about: About) -> Result<Self> {
        let failed = |error: std::io::Error| {
            Error::device(format!(
                "cannot serve the page at {}: {error}",
                SocketAddr::new(address.host, address.port)
            ))
            .help("choose another --port, or 0 for any that is free")
        };
        about.roots = about.roots.iter().filter_map(|root| root.canonicalize().ok()).collect();
        let loopback = address.host.is_loopback();
        let token = if loopback { None } else { Some(token()?) };
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build().map_err(failed)?;
        let listener = runtime.block_on(TcpListener::bind((address.host, address.port))).map_err(failed)?;
        let mut url = format!("http://{}/", listener.local_addr().map_err(failed)?);
        if let Some(token) = &token {
            url += &format!("?token={token}");
        }
        let desk = Arc::new(Desk {
            show: live.show().clone(),
            events: Mutex::new(live.events().clone()),
            guard: Guard { loopback, token },
            about,
        });
        let (stop, stopped) = oneshot::channel::<()>();
        let thread = std::thread::spawn(move || {
            runtime.block_on(async {
                tokio::select! {
                    // It ends by itself only when the listener is broken: pages then say that nobody answers
                    _ = axum::serve(listener, router(desk)) => {}
                    _ = stopped => {}
                }
            });
            // Pages that stopped reading are not waited for
            runtime.shutdown_background();
        });
        Ok(Self { url, stop: Some(stop), thread: Some(thread) })
    }

    /// Where the page is, with the token where one is needed.
    pub fn url(&self) -> &str {
        &self.url
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.stop.take());
        self.thread.take().map(JoinHandle::join);
    }
}

/// 128 random bits.
fn token() -> Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes)
        .map_err(|error| Error::device(format!("no random numbers for the token: {error}")))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

fn router(desk: Arc<Desk>) -> Router {
    Router::new()
        .route("/socket", get(connect))
        .route("/picture.png", get(|desk| picture(desk, Format::Png)))
        .route("/picture.exr", get(|desk| picture(desk, Format::Exr)))
        .route("/", get(|| async { file("") }))
        .route("/{name}", get(|Path(name): Path<String>| async move { file(&name) }))
        .layer(middleware::from_fn_with_state(desk.clone(), admit))
        .with_state(desk)
}

/// Answers only those who may ask.
async fn admit(State(desk): State<Arc<Desk>>, request: Request, next: Next) -> Response {
    let said = |headers: &HeaderMap, name| {
        headers.get(name).and_then(|value| value.to_str().ok()).map(str::to_owned)
    };
    let host = said(request.headers(), header::HOST);
    let origin = said(request.headers(), header::ORIGIN);
    let uri = request.uri();
    // Scripts and styles of the page are asked for by the browser, which adds no token
    let public =
        uri.path().strip_prefix('/').is_some_and(|name| !name.is_empty() && page::file(name).is_some());
    let asked = Asked { host: host.as_deref(), origin: origin.as_deref(), query: uri.query(), public };
    match desk.guard.check(&asked) {
        Ok(()) => next.run(request).await,
        Err(why) => (StatusCode::FORBIDDEN, format!("{why}\n")).into_response(),
    }
}

async fn connect(State(desk): State<Arc<Desk>>, upgrade: WebSocketUpgrade) -> Response {
    upgrade.max_message_size(MOST_SAID).on_upgrade(|socket| socket::talk(socket, desk))
}

/// Bytes of the longest message of a page.
const MOST_SAID: usize = 1 << 16;

fn file(name: &str) -> Response {
    let Some((kind, bytes)) = page::file(name) else {
        return (StatusCode::NOT_FOUND, "there is no such page\n").into_response();
    };
    let headers = [
        (header::CONTENT_TYPE, kind),
        (header::CACHE_CONTROL, "no-store"),
        (header::CONTENT_SECURITY_POLICY, "default-src 'self'; frame-ancestors 'none'"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    ];
    (headers, bytes).into_response()
}

/// The picture as it is now.
async fn picture(State(desk): State<Arc<Desk>>, format: Format) -> Response {
    let Some(shot) = desk.show.state().shot else {
        return (StatusCode::NOT_FOUND, "there is no picture yet\n").into_response();
    };
    let packed = tokio::task::spawn_blocking(move || {
        let film = &shot.generation.film;
        let meta = film::Meta::of(&shot.picture.frame, shot.spp);
        film::encode(format, &shot.picture, film, &meta)
    });
    let kind = match format {
        Format::Png => "image/png",
        Format::Exr => "image/x-exr",
    };
    match packed.await {
        Ok(Ok(bytes)) => {
            ([(header::CONTENT_TYPE, kind), (header::CACHE_CONTROL, "no-store")], bytes).into_response()
        }
        _ => (StatusCode::INTERNAL_SERVER_ERROR, "the picture cannot be written\n").into_response(),
    }
}
