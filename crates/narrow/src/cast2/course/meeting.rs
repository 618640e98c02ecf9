//! Whether circles around two parts meet at all, and when: tested before the parts themselves.

use crate::cast2::piece::Piece;
use crate::cast2::stretch::Stretch;
use crate::cast2::sum;

/// When circles around both parts may meet: from one time to another.
pub(in crate::cast2) fn meeting(stretch: &Stretch, pieces: [&Piece; 2], end: f64) -> Option<[f64; 2]> {
    let mut radii = 0.0;
    let mut offset = stretch.offset;
    for (which, sign) in [(0, -1.0), (1, 1.0)] {
        let (piece, spin) = (pieces[which], &stretch.spins[which]);
        radii += piece.outer;
        // A body that turns may have its part anywhere around its position.
        if spin.rounding > 0.0 {
            radii += piece.center.length() * (1.0 + 1e-6);
        } else {
            offset += spin.turn_at(0.0).turn(piece.center) * sign;
        }
    }
    if radii == f64::INFINITY {
        return Some([0.0, end]);
    }
    if stretch.is_turning() && passes_by(stretch, pieces) {
        return None;
    }
    // Once B's centre is as far behind A's as it was ahead, they have passed: no longer length enters the rounding.
    radii += stretch.lost(0.0) + 32.0 * f64::EPSILON * (sum(stretch.offset) + sum(offset) + radii);
    let (velocity, towards) = (stretch.velocity, offset.dot(stretch.velocity));
    let squared = velocity.length_squared();
    if squared == 0.0 || towards <= 0.0 {
        if offset.length_squared() > radii * radii {
            return None;
        }
        return Some([0.0, if squared == 0.0 { end } else { end.min((radii + radii) / squared.sqrt()) }]);
    }
    let nearest = towards / squared;
    let beside = (offset - velocity * nearest).length_squared();
    if beside > radii * radii {
        return None;
    }
    let half = ((radii * radii - beside) / squared).sqrt();
    let (first, last) = ((nearest - half).max(0.0), (nearest + half).min(end));
    (first <= last).then_some([first, last])
}

/// Whether circles that contain both parts throughout the stretch, about where those are when it begins, certainly pass
/// each other: a body that turns a little does not sweep all around its position.
fn passes_by(stretch: &Stretch, pieces: [&Piece; 2]) -> bool {
    let center = |i: usize| stretch.spins[i].turn_at(0.0).turn(pieces[i].center);
    let offset = stretch.offset + (center(1) - center(0));
    let held = |i: usize| pieces[i].outer + stretch.spins[i].chord() * pieces[i].center.length();
    let radii = (held(0) + held(1)) * (1.0 + 1e-6)
        + stretch.lost(1.0)
        + 1e-6 * (sum(pieces[0].center) + sum(pieces[1].center));
    let velocity = stretch.velocity;
    let nearest = (offset.dot(velocity) / velocity.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (offset - velocity * nearest).length_squared() > radii * radii
}
