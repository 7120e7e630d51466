//! Who may ask.

use std::net::IpAddr;

/// What a server lets in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Guard {
    /// Only names of this machine count; else a page of anyone could reach the server under a name of its own.
    pub loopback: bool,
    /// What each URL must have; none on this machine alone.
    pub token: Option<String>,
}

/// What a request says of itself.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Asked<'a> {
    pub host: Option<&'a str>,
    pub origin: Option<&'a str>,
    pub query: Option<&'a str>,
    /// It is for a file that is in every copy of the program.
    pub public: bool,
}

impl Guard {
    /// Whether a request is answered, or why not.
    pub fn check(&self, asked: &Asked<'_>) -> Result<(), &'static str> {
        let host = asked.host.ok_or("there is no host in the request")?;
        if self.loopback && !names_loopback(host) {
            return Err("this host is not the machine itself");
        }
        // What a page of this server asks has its origin; what is typed has none
        if asked.origin.is_some_and(|origin| origin.strip_prefix("http://") != Some(host)) {
            return Err("pages of other origins are not answered");
        }
        let given =
            asked.query.and_then(|query| query.split('&').find_map(|part| part.strip_prefix("token=")));
        match &self.token {
            Some(token) if !asked.public && !given.is_some_and(|given| same(given, token)) => {
                Err("the token is missing or wrong")
            }
            _ => Ok(()),
        }
    }
}

/// Whether a `Host` is this machine, under a name that nobody else can take.
fn names_loopback(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        _ => host,
    };
    let bare = name.trim_start_matches('[').trim_end_matches(']');
    name.eq_ignore_ascii_case("localhost") || bare.parse().is_ok_and(|address: IpAddr| address.is_loopback())
}

/// Compares in a time that does not tell how much is right.
fn same(a: &str, b: &str) -> bool {
    blake3::hash(a.as_bytes()) == blake3::hash(b.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked<'a>(host: &'a str, origin: Option<&'a str>, query: Option<&'a str>) -> Asked<'a> {
        Asked { host: Some(host), origin, query, public: false }
    }

    #[test]
    fn only_this_machine_and_its_own_pages_are_answered() {
        let guard = Guard { loopback: true, token: None };
        for host in ["127.0.0.1:8270", "localhost:8270", "[::1]:8270", "LOCALHOST", "127.9.9.9:1"] {
            assert_eq!(guard.check(&asked(host, None, None)), Ok(()), "{host}");
            let own = format!("http://{host}");
            assert_eq!(guard.check(&asked(host, Some(&own), None)), Ok(()), "{host}");
        }
        for host in ["evil.example:8270", "127.0.0.1.evil.example", "192.168.0.7:8270", "", "localhost.evil"]
        {
            assert!(guard.check(&asked(host, None, None)).is_err(), "{host}");
        }
        for origin in [
            "http://evil.example",
            "https://localhost:8270",
            "null",
            "http://localhost:1",
            "http://localhost:8270.evil",
        ] {
            assert!(guard.check(&asked("localhost:8270", Some(origin), None)).is_err(), "{origin}");
        }
        assert!(guard.check(&Asked::default()).is_err());
    }

    #[test]
    fn others_need_the_token() {
        let guard = Guard { loopback: false, token: Some("abc".into()) };
        let check = |query| guard.check(&asked("studio:8270", Some("http://studio:8270"), query));
        assert_eq!(check(Some("token=abc")), Ok(()));
        assert_eq!(check(Some("x=1&token=abc")), Ok(()));
        for query in
            [None, Some(""), Some("token=ab"), Some("token=abcd"), Some("token="), Some("atoken=abc")]
        {
            assert!(check(query).is_err(), "{query:?}");
        }
        assert!(guard.check(&asked("studio:8270", Some("http://evil"), Some("token=abc"))).is_err());
        // What anyone may have needs none, but goes to no other origin either
        let public = |origin| guard.check(&Asked { public: true, ..asked("studio:8270", origin, None) });
        assert_eq!(public(None), Ok(()));
        assert!(public(Some("http://evil")).is_err());
    }
}
