//! Why an axis stays the best while bodies slide: the patch that they rest on is wide.
//!
//! ```text
//! M = all differences a - b of points of A and B: the separation along n is the least of -m . n over M
//! n   the axis when the manifold was made; S the separation then; its points are at heights from `low` to `high`
//! w   the width: to every side M reaches out by w at those heights
//! an axis that leans by t from n showed a separation of
//!     high cos t - w sin t   at most, which has changed by no more than the drift d since:
//!         where sin t >= (high - low + 2 d) / w =: lean, it is not better than n is now
//!     nearer to n, it has changed as n has, up to   d (sin t + sin^2 t) + what turning did
//! an axis that points back is ruled out by a ball inside either body: M spans the patch and that ball
//! so the separation is S + the rise of the points, up to   d (lean + lean^2) + 5 spin * arm
//! ```
//! The last term bounds what turning by `spin` adds, where `arm` is how far the moving body reaches. Turning counts
//! twice, about the point that is deepest now and because another was deepest before, with a fifth part to spare. For
//! faces that rest on each other `lean` is a thousandth, so a drift of a millimetre costs a micrometre of error; and
//! that drift is the most by which points may lie beside where new ones would.
//!
//! Source: the polar form of the separating axis theorem (the separation is minus the support function of the Minkowski
//! difference: Cameron and Culley, "Determining the minimum translational distance between two convex polyhedra",
//! 1986).

/// Share of the smaller bounding radius by which two bodies may slide on wide ground, 2^-10: of cubes of a metre, 0.85
/// mm.
pub(crate) const SLIDE: f32 = 1.0 / 1024.0;

/// The same as a share of the patch's width: four points lose no more than a thirtieth of the patch.
const OF_WIDTH: f32 = 1.0 / 64.0;

/// The greatest difference of heights, as a share of the width.
const MOST_SLOPE: f32 = 1.0 / 32.0;

/// How wide the patch is on which two bodies rest on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Footing {
    /// Width of the patch, in metres.
    width: f32,
    /// Height of the highest point above the lowest, in metres.
    spread: f32,
    /// The greatest drift for which this holds, in metres.
    pub(crate) reach: f32,
}

/// Radii of a ball inside a body, and of one around it, in metres.
#[derive(Clone, Copy)]
pub(crate) struct Girth {
    pub(crate) inner: f32,
    pub(crate) outer: f32,
}

impl Footing {
    /// For a patch of this width, whose points and separation lie between these heights, up to an error; `None` where
    /// it is too narrow or too steep, or too deep in both bodies.
    pub(crate) fn new(width: f64, heights: [f32; 2], error: f32, girths: [Girth; 2]) -> Option<Self> {
        let least = girths[0].outer.min(girths[1].outer);
        // Points lie on their faces only up to what merging left and rounding took. And where all are deep,
        // `high cos t` is above `high`: by less than a 64th of the lean, as they are no deeper than half the width.
        let width = (width as f32 * (31.0 / 32.0) - least * (1.0 / 4096.0)).next_down();
        let spread = (heights[1] - heights[0] + 2.0 * error + least * f32::EPSILON * 8.0).next_up();
        let reach = (SLIDE * least).min(OF_WIDTH * width);
        let depth = heights[0].abs().max(heights[1].abs()) + 2.0 * reach + error;
        let is_held = |girth: &Girth| girth.inner >= depth + 2.0 * girth.outer * (depth / width);
        let is_wide = reach > 0.0 && spread <= MOST_SLOPE * width && 2.0 * depth <= width;
        (is_wide && girths.iter().any(is_held)).then_some(Self { width, spread, reach })
    }

    /// How far the separation may be off after a drift; `spun` is the angle turned times the arm.
    #[inline(always)]
    pub(crate) fn loss(&self, drift: f64, spun: f64) -> f64 {
        let lean = (f64::from(self.spread) + 2.0 * drift) / f64::from(self.width);
        drift * (lean + lean * lean) + 5.0 * spun
    }

    /// Whether a footing that was read from a file has possible values.
    pub(crate) fn is_sound(&self, arms: [f32; 2]) -> bool {
        let most = SLIDE * arms[0].min(arms[1]);
        (0.0..=most).contains(&self.reach)
            && (0.0..=MOST_SLOPE * self.width).contains(&self.spread)
            && self.width.is_finite()
            && self.reach <= OF_WIDTH * self.width
    }
}
