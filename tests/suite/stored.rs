//! Worlds as text, and back.
//!
//! Not in the tests' library: when rustdoc sees the opaque types here from `asunder-benches`, its stack overflows
//! (1.95).

use asunder::{Plane, Snapshot, Volume, World};
use asunder_tests::engine::Engine;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// A dimension's world as data, as text, and back.
pub(crate) trait Stored: Engine {
    /// `World::snapshot`.
    fn snapshot(world: &World<Self>) -> impl Serialize + DeserializeOwned + PartialEq + core::fmt::Debug;
    /// The snapshot's checksum.
    fn checksum(world: &World<Self>) -> u64;
    /// The snapshot, by serde_json.
    fn text(world: &World<Self>) -> String;
    /// `World::restore`, from such a text.
    fn restored(text: &str) -> Result<World<Self>, String>;
}

macro_rules! stored {
    ($($space:ty),*) => {$(
        impl Stored for $space {
            fn snapshot(world: &World<Self>) -> impl Serialize + DeserializeOwned + PartialEq + core::fmt::Debug {
                world.snapshot()
            }

            fn checksum(world: &World<Self>) -> u64 {
                world.snapshot().checksum()
            }

            fn text(world: &World<Self>) -> String {
                serde_json::to_string(&world.snapshot()).unwrap()
            }

            fn restored(text: &str) -> Result<World<Self>, String> {
                let snapshot: Snapshot<Self> = serde_json::from_str(text).map_err(|error| error.to_string())?;
                World::restore(&snapshot).map_err(|error| error.to_string())
            }
        }
    )*};
}

stored!(Plane, Volume);
