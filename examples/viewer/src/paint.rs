//! Colours.

use asunder::Tier;

/// Red, green, blue and opacity, 0 to 1.
#[derive(Clone, Copy)]
pub(crate) struct Paint(pub(crate) [f32; 4]);

impl Paint {
    pub(crate) const SCENERY: Self = Self([0.80, 0.79, 0.76, 1.0]);
    pub(crate) const DRIVEN: Self = Self([0.62, 0.68, 0.74, 1.0]);
    pub(crate) const SENSOR: Self = Self([0.98, 0.80, 0.25, 0.4]);
    pub(crate) const WOOD: Self = Self([0.88, 0.66, 0.40, 1.0]);
    pub(crate) const STONE: Self = Self([0.60, 0.66, 0.73, 1.0]);
    pub(crate) const BALL: Self = Self([0.90, 0.40, 0.33, 1.0]);
    pub(crate) const RUBBER: Self = Self([0.48, 0.70, 0.46, 1.0]);
    pub(crate) const METAL: Self = Self([0.36, 0.60, 0.76, 1.0]);
    pub(crate) const INK: Self = Self([0.13, 0.12, 0.14, 1.0]);
    /// For bodies without a contact whose tier is known.
    pub(crate) const PALE: Self = Self([0.80, 0.81, 0.83, 1.0]);
    /// For lines between candidate pairs.
    pub(crate) const PAIR: Self = Self([0.45, 0.20, 0.62, 0.8]);
    const NIGHT: [f32; 3] = [0.35, 0.38, 0.55];

    /// The colour of the tier that decided a pair.
    pub(crate) fn of_tier(tier: Tier) -> Self {
        match tier {
            Tier::Bound => Self([0.25, 0.66, 0.35, 1.0]),
            Tier::Double => Self([0.93, 0.70, 0.13, 1.0]),
            Tier::Exact => Self([0.86, 0.22, 0.27, 1.0]),
        }
    }

    /// A little lighter or darker by body number, so that neighbours stand apart.
    pub(crate) fn varied(self, number: usize) -> Self {
        let scrambled = (number as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
        let tone = 0.86 + 0.26 * (scrambled as f32 / (1 << 24) as f32);
        let [r, g, b, a] = self.0;
        Self([r * tone, g * tone, b * tone, a])
    }

    pub(crate) fn faint(self, opacity: f32) -> Self {
        let [r, g, b, _] = self.0;
        Self([r, g, b, opacity])
    }

    /// The colour of a sleeping body.
    pub(crate) fn asleep(self) -> Self {
        let [r, g, b, a] = self.0;
        let [night_r, night_g, night_b] = Self::NIGHT;
        Self([0.45 * r + 0.55 * night_r, 0.45 * g + 0.55 * night_g, 0.45 * b + 0.55 * night_b, a])
    }

    /// Shaded, in macroquad's format.
    pub(crate) fn bytes(self, shade: f32) -> [u8; 4] {
        let [r, g, b, a] = self.0;
        [r * shade, g * shade, b * shade, a].map(|c| (c * 255.0).clamp(0.0, 255.0) as u8)
    }
}
