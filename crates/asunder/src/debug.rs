//! Lines that show what the engine sees: coordinates to draw, not a renderer.

mod plane;
mod volume;

use asunder_geometry::tolerance;

/// What [`World2::debug_lines`](crate::World2::debug_lines) and [`World3::debug_lines`](crate::World3::debug_lines)
/// draw.
///
/// ```
/// use asunder::DebugOptions;
/// let options = DebugOptions { boxes: true, ..DebugOptions::default() };
/// assert!(options.shapes && options.contacts && options.normals);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DebugOptions {
    /// The outline of every enabled body at its current pose. On by default.
    pub shapes: bool,
    /// The boxes of the broad phase, as of the last update; none around half-spaces. In a restored world that has not
    /// been updated yet, the boxes around bodies at their current poses. Off by default.
    pub boxes: bool,
    /// The non-empty columns into which the broad phase last sorted boxes. They affect its speed but not the contacts,
    /// and depend on the world's history. Off by default.
    pub columns: bool,
    /// A cross at each contact point, half-way between the two bodies, as of the last update. On by default.
    pub contacts: bool,
    /// The normal at each contact point, drawn from there towards the body in the higher slot. On by default.
    pub normals: bool,
    /// Length of a normal, in metres, at most 1e6; 0.2 by default. The size of a cross is a quarter of it. A NaN counts
    /// as 0; a negative length reverses the normal.
    pub length: f32,
    /// Half the side of the patch that represents a half-space, in metres, at most 1e6; 20 by default. A NaN counts
    /// as 0.
    pub endless: f32,
}

impl Default for DebugOptions {
    fn default() -> Self {
        Self {
            shapes: true,
            boxes: false,
            columns: false,
            contacts: true,
            normals: true,
            length: 0.2,
            endless: 20.0,
        }
    }
}

impl DebugOptions {
    /// Half of the side of a patch; zero for a NaN.
    fn half_patch(&self) -> f64 {
        if self.endless > 0.0 { f64::from(self.endless.min(tolerance::MAX_RADIUS)) } else { 0.0 }
    }

    /// Length of a normal; zero for a NaN. A negative one turns the normal around.
    fn length_of_normal(&self) -> f64 {
        let most = tolerance::MAX_RADIUS;
        if self.length.is_nan() { 0.0 } else { f64::from(self.length.clamp(-most, most)) }
    }
}

/// The kind of a line, by which to choose a colour.
///
/// ```
/// use asunder::DebugLine;
/// let colour = |what: DebugLine| what.colour();
/// assert_eq!(colour(DebugLine::Contact), [255, 64, 64, 255]);
/// let bodies = [DebugLine::Body, DebugLine::Fixed, DebugLine::Sensor, DebugLine::Asleep].map(colour);
/// let others = [DebugLine::Box, DebugLine::Column, DebugLine::Normal].map(colour);
/// assert!(bodies.iter().all(|known| !others.contains(known)), "none is taken for another");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DebugLine {
    /// The outline of a movable body.
    Body,
    /// The outline of a fixed body.
    Fixed,
    /// The outline of a sensor.
    Sensor,
    /// The outline of a sleeping body.
    Asleep,
    /// A box of the broad phase.
    Box,
    /// A column of the broad phase.
    Column,
    /// A contact point.
    Contact,
    /// A contact's normal.
    Normal,
}

impl DebugLine {
    /// A colour that distinguishes this kind from the others on dark and on light backgrounds: red, green, blue and
    /// opacity, as sRGB.
    pub const fn colour(self) -> [u8; 4] {
        match self {
            Self::Body => [80, 160, 255, 255],
            Self::Fixed => [140, 140, 140, 255],
            Self::Sensor => [90, 200, 120, 255],
            Self::Asleep => [70, 90, 160, 255],
            Self::Box => [200, 180, 60, 160],
            Self::Column => [60, 150, 140, 160],
            Self::Contact => [255, 64, 64, 255],
            Self::Normal => [255, 150, 40, 255],
        }
    }

    fn of<S: crate::Space>(body: &crate::Collider<S>) -> Self {
        match (body.is_sensor(), body.is_fixed(), body.is_asleep()) {
            (true, ..) => Self::Sensor,
            (_, true, _) => Self::Fixed,
            (.., true) => Self::Asleep,
            _ => Self::Body,
        }
    }
}

/// How often an arc of at most half a circle is halved: a quarter circle is then off by at most 0.5 % of its radius.
const HALVINGS: u32 = 3;

/// Whether a line has a point in a box. Testing the line's own box is not enough: with ground that is turned, it
/// overlaps regions that none of the line's triangles comes near, and only the ground near a region is drawn.
fn reaches_into<const N: usize>([low, high]: [[f64; N]; 2], [from, to]: [[f64; N]; 2]) -> bool {
    let mut within = [0.0_f64, 1.0];
    for axis in 0..N {
        let (low, high, start, end) = (low[axis], high[axis], from[axis], to[axis]);
        // A box with a NaN contains nothing.
        if !(start.min(end) <= high && start.max(end) >= low) {
            return false;
        }
        let way = end - start;
        if way != 0.0 {
            let (entry, exit) = if way > 0.0 { (low, high) } else { (high, low) };
            within[0] = within[0].max((entry - start) / way);
            within[1] = within[1].min((exit - start) / way);
        }
    }
    within[0] <= within[1]
}
