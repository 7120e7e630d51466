//! One page that is connected. It asks for each picture, so one that is slow gets fewer, and one that is gone none.

use super::Desk;
use super::frame;
use super::message::{Probe, Said, Saying, Stand, Want, Which};
use crate::live::{Event, Shot, State};
use crate::scene::{Camera, Focus, Projection};
use axum::extract::ws::{Message, WebSocket};
use glam::Vec3;
use std::sync::Arc;

/// Talks with a page until it is gone.
pub(super) async fn talk(mut socket: WebSocket, desk: Arc<Desk>) {
    let mut changes = desk.show.changes();
    changes.mark_changed();
    let mut want = None;
    loop {
        let next = tokio::select! {
            message = socket.recv() => Next::Heard(message),
            _ = changes.changed() => Next::Changed,
        };
        let done = match next {
            Next::Changed => tell(&mut socket, &desk.state()).await,
            Next::Heard(Some(Ok(Message::Text(text)))) => match serde_json::from_str(&text) {
                Ok(said) => answer(said, &mut want, &mut socket, &desk).await,
                Err(_) => tell(&mut socket, &Saying::Failed("this is no message of the page")).await,
            },
            // Pings are answered by the library, and a page sends nothing else
            Next::Heard(Some(Ok(Message::Ping(_) | Message::Pong(_)))) => Some(()),
            Next::Heard(_) => None,
        };
        if done.is_none() || show(&mut want, &mut socket, &desk).await.is_none() {
            return;
        }
    }
}

enum Next {
    Heard(Option<Result<Message, axum::Error>>),
    Changed,
}

/// None when the page is gone, as of all that follow.
async fn tell(socket: &mut WebSocket, saying: &Saying) -> Option<()> {
    let text = serde_json::to_string(saying).ok()?;
    socket.send(Message::Text(text.into())).await.ok()
}

async fn answer(said: Said, want: &mut Option<Want>, socket: &mut WebSocket, desk: &Desk) -> Option<()> {
    match said {
        Said::Frame(asked) if matches!(asked.scale, 1 | 2 | 4 | 8) => *want = Some(asked),
        Said::Frame(_) => return tell(socket, &Saying::Failed("the scale is 1, 2, 4 or 8")).await,
        Said::Probe(at) => {
            return match probe(desk, at) {
                Some(probe) => tell(socket, &Saying::Probe(probe)).await,
                None => tell(socket, &Saying::Failed("there is no such pixel")).await,
            };
        }
        Said::Look(stand) => {
            let state = desk.show.state();
            match stand.map(|stand| looked_from(&state, &stand)) {
                None => desk.tell(Event::Look(None)),
                Some(Some(camera)) => desk.tell(Event::Look(Some(camera))),
                Some(None) => return tell(socket, &Saying::Failed("a camera cannot stand so")).await,
            }
        }
        Said::Focus(at) => match focused(&desk.show.state(), at) {
            Some(camera) => desk.tell(Event::Look(Some(camera))),
            None => return tell(socket, &Saying::Failed("there is nothing to focus on")).await,
        },
    }
    Some(())
}

/// The values of a pixel. What it shows is asked for where it is not known: the state will change when it is.
fn probe(desk: &Desk, at: [u32; 2]) -> Option<Probe> {
    let State { shot, picks, .. } = desk.show.state();
    let shot = shot?;
    let probe = Probe::of(&shot, at)?;
    match picks.filter(|picks| picks.generation == shot.generation.number) {
        Some(picks) => Some(probe.named(&picks)),
        None => {
            desk.tell(Event::Pick);
            Some(probe)
        }
    }
}

/// Sends the picture that is wanted, if there is a new one.
async fn show(want: &mut Option<Want>, socket: &mut WebSocket, desk: &Desk) -> Option<()> {
    let Some(asked) = *want else { return Some(()) };
    let state = desk.show.state();
    let shot = match asked.which {
        Which::Now => state.shot,
        Which::Before => state.before,
    };
    let Some(shot) = shot.filter(|shot| shot.serial > asked.after) else { return Some(()) };
    *want = None;
    // Not on the thread that answers others
    let packed = tokio::task::spawn_blocking(move || frame::encode(&shot, &asked)).await.ok()?.ok()?;
    socket.send(Message::Binary(packed.into())).await.ok()
}

/// The camera of the scene at another place.
fn looked_from(state: &State, stand: &Stand) -> Option<Camera> {
    let camera = state.generation.as_ref()?.camera.clone();
    let [position, target, up] = [stand.position, stand.target, stand.up].map(Vec3::from);
    let view = target - position;
    let sound = [position, target, up].iter().all(|v| v.is_finite())
        && view.length_squared().is_normal()
        && view.normalize().cross(up.normalize_or_zero()).length_squared() > 1e-8;
    sound.then(|| Camera { position, target, up: up.normalize(), at_close: None, ..camera })
}

/// The camera with what is seen in a pixel sharp.
fn focused(state: &State, at: [u32; 2]) -> Option<Camera> {
    let shot: &Shot = state.shot.as_ref()?;
    let depth = Probe::of(shot, at)?.depth()?;
    let mut camera = shot.generation.camera.clone();
    let film = &shot.generation.film;
    let Projection::Perspective(view) = &mut camera.projection else { return None };
    let tan = (0.5 * view.fov.to_radians()).tan();
    let lens = view.lens.as_mut()?;
    // Depth is along the ray, and the plane across the view
    let aspect = film.width as f32 / film.height as f32;
    let half = crate::scene::half_height(view.fov_axis, tan, aspect);
    let place = |pixel: u32, size: u32| (pixel as f32 + 0.5) / size as f32 * 2.0 - 1.0;
    let (x, y) = (place(at[0], film.width) * half * aspect, place(at[1], film.height) * half);
    lens.focus = Focus::Distance(depth / Vec3::new(x, y, 1.0).length());
    Some(camera)
}
