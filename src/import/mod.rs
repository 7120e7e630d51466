//! Files → [`crate::scene::Scene`].
