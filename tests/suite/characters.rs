//! Characters: what they never do (enter, pass through, tremble), and how a player expects them to behave on floors,
//! stairs, slopes and along walls; in space and in the plane.

mod carried;
mod edges;
mod ends;
mod freeing;
mod orders;
mod parts;
mod plane;
mod pressed;
mod rooms;
pub(crate) mod stage;
mod standing_up;
mod walking;
mod walls;
