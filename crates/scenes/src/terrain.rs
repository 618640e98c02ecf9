//! Rolling hills, cut into triangles.

use crate::random::Random;
use core::f64::consts::TAU;
use glam::{DVec2, DVec3, Vec3};

/// Hills over a square, as a height for each place: a sum of waves, each of a height proportional to its length.
///
/// ```
/// use asunder_scenes::terrain::Terrain;
/// let terrain = Terrain::new(20_000, 1.0, 7);
/// assert_eq!((terrain.cells(), terrain.triangles().len()), (100, 20_000));
/// assert_eq!(terrain.vertices().len(), 101 * 101);
/// let (height, normal) = terrain.under([12.5, 30.25]);
/// assert!(height.abs() < 20.0 && normal.y > 0.5 && (normal.length() - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug)]
pub struct Terrain {
    cells: usize,
    cell: f64,
    waves: Vec<Wave>,
}

#[derive(Clone, Copy, Debug)]
struct Wave {
    /// Radians a metre, along x and z.
    along: DVec2,
    phase: f64,
    height: f64,
}

/// The greatest slope of each wave.
const SLOPE: f64 = 0.1;

impl Terrain {
    /// Hills of about so many triangles, in square cells `cell` metres wide, two triangles each.
    pub fn new(triangles: usize, cell: f64, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let wave = |length: f64| {
            let angle = random.range(0.0, TAU);
            let along = DVec2::new(libm::cos(angle), libm::sin(angle)) * (TAU / length);
            Wave { along, phase: random.range(0.0, TAU), height: SLOPE * length / TAU }
        };
        let waves = [97.0, 61.0, 38.0, 23.0, 11.0, 7.0, 4.3].map(wave).to_vec();
        Self { cells: ((triangles as f64 / 2.0).sqrt().round() as usize).max(1), cell, waves }
    }

    /// A plane of about so many triangles, divided as the hills are, at height 0.
    ///
    /// ```
    /// use asunder_scenes::terrain::Terrain;
    /// let terrain = Terrain::flat(800, 0.5);
    /// assert!(terrain.vertices().iter().all(|vertex| vertex.y == 0.0) && terrain.side() == 10.0);
    /// ```
    pub fn flat(triangles: usize, cell: f64) -> Self {
        Self { waves: Vec::new(), ..Self::new(triangles, cell, 0) }
    }

    /// The number of cells along each side.
    pub const fn cells(&self) -> usize {
        self.cells
    }

    /// The length of a side in metres.
    pub const fn side(&self) -> f64 {
        self.cells as f64 * self.cell
    }

    /// The height at a place, in metres.
    fn height(&self, place: DVec2) -> f64 {
        self.waves.iter().map(|wave| wave.height * libm::sin(wave.along.dot(place) + wave.phase)).sum()
    }

    /// The vertices row by row: from the origin along x, then along z.
    pub fn vertices(&self) -> Vec<Vec3> {
        (0..=self.cells)
            .flat_map(|row| (0..=self.cells).map(move |column| self.vertex(column, row)))
            .collect()
    }

    fn vertex(&self, column: usize, row: usize) -> Vec3 {
        let place = DVec2::new(column as f64, row as f64) * self.cell;
        DVec3::new(place.x, self.height(place), place.y).as_vec3()
    }

    /// The triangles by their vertices' indices, counter-clockwise from above, two a cell.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let row = self.cells as u32 + 1;
        let of_cell = |column: u32, from: u32| {
            let corner = from * row + column;
            [[corner, corner + row, corner + 1], [corner + 1, corner + row, corner + row + 1]]
        };
        (0..row - 1).flat_map(|from| (0..row - 1).flat_map(move |column| of_cell(column, from))).collect()
    }

    /// The height and normal of the triangle over or under a place. Beyond the rim, the nearest cell is extended.
    pub fn under(&self, place: impl Into<DVec2>) -> (f64, DVec3) {
        let place = place.into();
        let cell = |along: f64| (along / self.cell).clamp(0.0, self.cells as f64 - 1.0) as usize;
        let (column, row) = (cell(place.x), cell(place.y));
        let inside = place / self.cell - DVec2::new(column as f64, row as f64);
        let corners = if inside.x + inside.y <= 1.0 {
            [(column, row), (column, row + 1), (column + 1, row)]
        } else {
            [(column + 1, row), (column, row + 1), (column + 1, row + 1)]
        };
        let [a, b, c] = corners.map(|(column, row)| self.vertex(column, row).as_dvec3());
        let normal = (b - a).cross(c - a).normalize();
        let aside = DVec3::new(place.x - a.x, 0.0, place.y - a.z);
        (a.y - normal.dot(aside) / normal.y, normal)
    }
}
