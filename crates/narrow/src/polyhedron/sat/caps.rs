//! Which octets of arcs lie near an arc at all, decided by a cap of the Gauss map around each.
//!
//! For two hulls of 256 vertices so symmetric that nothing is culled, 762 arcs are tested against 96 octets, 17 ns
//! each. The edges of large hulls are sorted by the direction they face, so that the caps around eight of them are
//! small: one step decides for eight caps whether an arc may reach any of their arcs.
//!
//! Arcs cross at a point that is in both their caps, so the caps' centres are no further apart than the sum of both
//! radii. The cosine of that sum is a product of cosines less a product of sines: no angle is ever computed.

use crate::counted::count_step;
use asunder_geometry::EdgeArc;
use asunder_geometry::glam::Vec3;
use asunder_geometry::tolerance::ARC_SLACK;

/// Slack for both sides of the comparison, each of which is off by less than 4e-6: vectors rotated into other axes, by
/// 6e-7 each, and sums of three products.
const SLACK: f32 = ARC_SLACK as f32 + 1e-5;

/// Caps whose cosine is below this become the whole sphere: only in caps up to a hemisphere does an arc lie inside if
/// its ends do.
const WIDEST: f32 = 0.01;

/// A cap of the Gauss map.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    /// Zero for the whole sphere.
    center: Vec3,
    /// Cosine and sine of its radius.
    cosine: f32,
    sine: f32,
}

impl Cap {
    const WHOLE: Self = Self { center: Vec3::ZERO, cosine: 0.0, sine: 1.0 };

    /// The cap about a direction that holds the ends of arcs.
    fn about(center: Vec3, ends: impl Iterator<Item = Vec3>) -> Self {
        let least = ends
            .map(|end| end.dot(center))
            .fold(1.0, |least: f32, end| if end < least { end } else { least });
        // Slightly wider, so that rounding does not make a small cap too small.
        let cosine = least - 1e-6;
        if cosine < WIDEST {
            return Self::WHOLE;
        }
        Self { center, cosine, sine: (1.0 - cosine * cosine).sqrt() }
    }

    /// Around one arc.
    pub(super) fn of_arc(arc: &EdgeArc) -> Self {
        Self::about(arc.middle, arc.ends.into_iter())
    }

    /// Around several arcs, given the middles and both ends of each.
    pub(super) fn of_arcs(middles: impl Iterator<Item = Vec3>, ends: impl Iterator<Item = Vec3>) -> Self {
        Self::about(middles.fold(Vec3::ZERO, |sum, middle| sum + middle).normalize_or_zero(), ends)
    }

    /// Whether arcs inside this cap and negatives of arcs inside another may meet.
    #[cfg(test)]
    pub(super) fn may_meet_negative(&self, other: &Self) -> bool {
        let (c, d) = (self.center, other.center);
        let cosine = -(c.x * d.x + c.y * d.y + c.z * d.z);
        cosine >= self.cosine * other.cosine - self.sine * other.sine - SLACK
    }
}

/// Eight caps side by side. Lanes past the last are whole spheres.
#[derive(Clone, Copy)]
pub(super) struct CapOctet {
    center: [[f32; 8]; 3],
    cosine: [f32; 8],
    sine: [f32; 8],
}

impl CapOctet {
    pub(super) fn new(caps: impl Iterator<Item = Cap>) -> Self {
        let mut octet =
            Self { center: [[0.0; 8]; 3], cosine: [Cap::WHOLE.cosine; 8], sine: [Cap::WHOLE.sine; 8] };
        for (i, cap) in caps.take(8).enumerate() {
            for axis in 0..3 {
                octet.center[axis][i] = cap.center[axis];
            }
            (octet.cosine[i], octet.sine[i]) = (cap.cosine, cap.sine);
        }
        octet
    }

    /// `may_meet_negative` of one cap against eight: 1 where they may meet, else 0.
    #[inline]
    pub(super) fn may_meet_negative(&self, cap: &Cap) -> [u32; 8] {
        count_step();
        let (c, [x, y, z]) = (cap.center, &self.center);
        let mut near = [0; 8];
        for (i, near) in near.iter_mut().enumerate() {
            let cosine = -(c.x * x[i] + c.y * y[i] + c.z * z[i]);
            *near = u32::from(cosine >= cap.cosine * self.cosine[i] - cap.sine * self.sine[i] - SLACK);
        }
        near
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::Random;
    use super::*;

    /// An arc near a direction, of a length set by `reach`, some nearly a half circle; and a random point on it.
    fn arc(random: &mut Random, about: Vec3, reach: f32) -> (EdgeArc, Vec3) {
        let mut near = || (about + reach * random.vector()).normalize_or(Vec3::X);
        let (left, right) = (near(), near());
        let share = 0.5 + 0.5 * random.number();
        let at = (left * share + right * (1.0 - share)).normalize_or(left);
        let along = left.cross(right).normalize_or(Vec3::X);
        (EdgeArc { along, ends: [left, right], middle: (left + right).normalize_or_zero() }, at)
    }

    #[test]
    fn arcs_that_meet_lie_in_caps_that_meet_and_lanes_agree_with_the_definition() {
        let mut random = Random(0x3C79_AC49_2BA7_B653);
        let (mut meeting, mut apart, mut whole) = (0, 0, 0);
        for case in 0..4000 {
            let reach = [1e-5, 1e-3, 0.05, 0.4, 3.0][case % 5];
            let about = random.vector();
            let share = random.number().abs();
            let (one, at) = arc(&mut random, about.normalize_or(Vec3::X), reach * share);
            // The arcs of the first four caps end where the negative of the first arc passes; the others lie anywhere.
            let caps: [Cap; 8] = core::array::from_fn(|i| {
                let about = if i < 4 { -at } else { random.vector() };
                let arcs: [EdgeArc; 3] = core::array::from_fn(|_| arc(&mut random, about, reach).0);
                let through = |arc: EdgeArc| EdgeArc { ends: [-at, arc.ends[1]], ..arc };
                let arcs = if i < 4 { arcs.map(through) } else { arcs };
                let middles = arcs.iter().map(|arc| (arc.ends[0] + arc.ends[1]).normalize_or_zero());
                Cap::of_arcs(middles, arcs.iter().flat_map(|arc| arc.ends))
            });
            let cap = Cap::of_arc(&one);
            let lanes = CapOctet::new(caps.into_iter()).may_meet_negative(&cap).map(|lane| lane != 0);
            assert_eq!(lanes, caps.map(|other| cap.may_meet_negative(&other)));
            assert!(lanes[..4].iter().all(|&lane| lane), "case {case}: {one:?}, {cap:?}, {caps:?}");
            meeting += lanes[4..].iter().filter(|&&lane| lane).count();
            apart += lanes[4..].iter().filter(|&&lane| !lane).count();
            whole += caps.iter().filter(|cap| cap.center == Vec3::ZERO).count();
        }
        assert!(meeting > 1000 && apart > 5000 && whole > 1000, "{meeting}, {apart}, {whole}");
    }

    #[test]
    fn half_circles_and_whole_circles_are_in_no_smaller_cap_than_the_whole_sphere() {
        let half = EdgeArc { along: Vec3::Z, ends: [Vec3::X, -Vec3::X], middle: Vec3::Y };
        let circle = EdgeArc { along: Vec3::Z, ends: [Vec3::ZERO; 2], middle: Vec3::ZERO };
        for wide in [half, circle] {
            let cap = Cap::of_arc(&wide);
            let point = |at: Vec3| Cap::of_arc(&EdgeArc { along: Vec3::Z, ends: [at; 2], middle: at });
            for at in [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z] {
                assert!(cap.may_meet_negative(&point(at)), "{wide:?}, {at}");
            }
            assert!(cap.may_meet_negative(&cap));
        }
    }
}
