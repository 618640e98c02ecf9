//! Colours, and the light that all pictures share.

use asunder::glam::{DVec2, DVec3};

/// Red, green, blue, each 0 to 1.
pub(crate) type Color = DVec3;

/// Borders of marks.
pub(crate) const WHITE: Color = DVec3::ONE;
/// Dark lines and text.
pub(crate) const INK: Color = DVec3::new(0.16, 0.19, 0.24);
/// Captions of less weight.
pub(crate) const GREY: Color = DVec3::new(0.42, 0.46, 0.52);
/// The card behind a whole picture: it has its own background, so that it is also legible on dark pages.
pub(crate) const PAPER: Color = DVec3::new(0.945, 0.955, 0.965);
/// The card behind one cell.
pub(crate) const CARD: Color = DVec3::new(0.995, 0.996, 1.0);
/// Contact normals.
pub(crate) const NORMAL: Color = DVec3::new(0.75, 0.06, 0.28);

/// The x and y, for the viewer, of the normal that is lit fully: to the left and above.
pub(crate) const LIGHT: DVec2 = DVec2::new(-0.30, 0.62);
/// The greatest distance of a visible normal's x and y from that.
pub(crate) const REACH: f64 = 1.70;

/// The colours of one body.
#[derive(Clone, Copy)]
pub(crate) struct Tint {
    /// Identifies the tint in the ids of gradients.
    pub name: char,
    /// Shades from fully lit to facing away, at [`Tint::STOPS`].
    pub ramp: [Color; 3],
    /// Outlines and contact points.
    pub ink: Color,
}

/// The first body of a pair.
pub(crate) const COOL: Tint = Tint {
    name: 'a',
    ramp: [DVec3::new(0.80, 0.93, 0.98), DVec3::new(0.40, 0.68, 0.83), DVec3::new(0.10, 0.33, 0.52)],
    ink: DVec3::new(0.05, 0.24, 0.42),
};

/// The second body of a pair.
pub(crate) const WARM: Tint = Tint {
    name: 'b',
    ramp: [DVec3::new(1.00, 0.93, 0.74), DVec3::new(0.96, 0.69, 0.32), DVec3::new(0.70, 0.33, 0.08)],
    ink: DVec3::new(0.50, 0.21, 0.02),
};

impl Tint {
    /// The positions of the shades on a ramp, from 0 to 1.
    pub(crate) const STOPS: [f64; 3] = [0.0, 0.5, 1.0];

    /// The shade of a surface with this unit normal in the viewer's axes: x right, y up, z towards the viewer.
    ///
    /// It depends only on the distance between the normal's x and y and those of the light. So one radial gradient
    /// shades a ball exactly, flat faces have one shade, and no seam shows where they meet.
    pub(crate) fn shade(&self, normal: DVec3) -> Color {
        let away = ((normal.truncate() - LIGHT).length() / REACH).min(1.0);
        let [lit, base, dark] = self.ramp;
        if away < 0.5 { lit.lerp(base, away * 2.0) } else { base.lerp(dark, away * 2.0 - 1.0) }
    }

    /// The most common shade of the body.
    pub(crate) const fn base(&self) -> Color {
        self.ramp[1]
    }
}

/// The colour as SVG writes it.
pub(crate) fn hex(color: Color) -> String {
    let [r, g, b] = (color * 255.0).to_array().map(|c| c.round().clamp(0.0, 255.0) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
