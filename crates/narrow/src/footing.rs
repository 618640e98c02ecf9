//! Why an axis stays the best while bodies slide: what carries them is wide.
//!
//! ```text
//! M = all differences a - b of points of A and B: the separation along n is the least of -m . n over M
//! n   the axis when the manifold was made; S the separation then; points of it are at heights from `low` to `high`
//! w   the width: to every side M reaches out by w at those heights
//! an axis that leans by t from n:
//!     was at   high cos t - w sin t   at most, and has changed by no more than the drift d since:
//!         where sin t >= (high - low + 2 d) / w =: lean, it is not better than n is now
//!     nearer than that, it has changed by what n has, up to   d (sin t + sin^2 t) + what turning did
//! an axis that points back: a ball in either body, which the patch and the ball span M to, keeps it away
//! so the separation is S + the rise of the points, up to   d (lean + lean^2) + 5 spin * arm
//! ```
//! The last term bounds what turning by `spin` adds, where `arm` is how far the moving body reaches: counted once about
//! the point that is deepest now, once since another was deepest before, with a fifth part to spare. For faces that
//! rest on each other `lean` is a thousandth, so a drift of a millimetre costs a micrometre of error, and is all that
//! points may stand beside where new ones would.
//!
//! Source: the polar form of the separating axis theorem (the separation is minus the support function of the Minkowski
//! difference: Cameron and Culley, "Determining the minimum translational distance between two convex polyhedra",
//! 1986).

/// Share of the smaller bounding radius by which two bodies may slide on wide ground, 2^-10: of cubes of a metre, 0.85
/// mm.
pub(crate) const SLIDE: f32 = 1.0 / 1024.0;

/// Share of the width by which they may: four points lose no more than a thirtieth of the patch.
const OF_WIDTH: f32 = 1.0 / 64.0;

/// Most that heights may differ by, as a share of the width.
const MOST_SLOPE: f32 = 1.0 / 32.0;

/// How wide two bodies stand on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Footing {
    /// In metres.
    width: f32,
    /// Between the lowest of the points and the highest, in metres.
    spread: f32,
    /// Up to which drift it is told by this, in metres.
    pub(crate) reach: f32,
}

/// A ball in a body, and one around it: inner and outer radius, in metres.
#[derive(Clone, Copy)]
pub(crate) struct Girth {
    pub(crate) inner: f32,
    pub(crate) outer: f32,
}

impl Footing {
    /// Of a patch so wide, whose points and separation are at these heights, up to an error; nothing where it is too
    /// narrow, too steep, or too deep for the bodies on it.
    pub(crate) fn new(width: f64, heights: [f32; 2], error: f32, girths: [Girth; 2]) -> Option<Self> {
        let least = girths[0].outer.min(girths[1].outer);
        // Points stand on their faces up to what merging left and rounding took. And where all are below, `high` counts
        // for less at an angle: by less than a 64th of the lean, as they are no deeper than half the width.
        let width = (width as f32 * (31.0 / 32.0) - least * (1.0 / 4096.0)).next_down();
        let spread = (heights[1] - heights[0] + 2.0 * error + least * f32::EPSILON * 8.0).next_up();
        let reach = (SLIDE * least).min(OF_WIDTH * width);
        let depth = heights[0].abs().max(heights[1].abs()) + 2.0 * reach + error;
        let is_held = |girth: &Girth| girth.inner >= depth + 2.0 * girth.outer * (depth / width);
        let is_wide = reach > 0.0 && spread <= MOST_SLOPE * width && 2.0 * depth <= width;
        (is_wide && girths.iter().any(is_held)).then_some(Self { width, spread, reach })
    }

    /// How far the separation may be off after a drift, and bodies that turned by so much, times the arm.
    #[inline(always)]
    pub(crate) fn loss(&self, drift: f64, spun: f64) -> f64 {
        let lean = (f64::from(self.spread) + 2.0 * drift) / f64::from(self.width);
        drift * (lean + lean * lean) + 5.0 * spun
    }

    /// Whether these can be the numbers of one: of what was read from a file.
    pub(crate) fn is_sound(&self, arms: [f32; 2]) -> bool {
        let most = SLIDE * arms[0].min(arms[1]);
        (0.0..=most).contains(&self.reach)
            && (0.0..=MOST_SLOPE * self.width).contains(&self.spread)
            && self.width.is_finite()
            && self.reach <= OF_WIDTH * self.width
    }
}
