//! Half-edges: how the vertices, edges and faces of a polyhedron are connected.

use std::sync::LazyLock;

/// A directed edge of a face, from its origin to the origin of the next.
///
/// ```
/// use asunder::Cuboid;
/// let topology = Cuboid::topology();
/// let around = topology.face_half_edges(0);
/// assert_eq!(around.len(), 4);
/// for half_edge in around {
///     let edge = topology.half_edges()[half_edge];
///     let twin = topology.half_edges()[usize::from(edge.twin)];
///     assert_eq!((edge.face, usize::from(twin.twin)), (0, half_edge));
///     assert_eq!(topology.ends(half_edge), (edge.origin.into(), twin.origin.into()));
///     assert_eq!(topology.edge_of(half_edge), topology.edge_of(edge.twin.into()), "one edge, two halves");
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HalfEdge {
    /// The vertex it starts from.
    pub origin: u16,
    /// The half-edge that runs the other way, in the neighbouring face.
    pub twin: u16,
    /// The next one around the face, counter-clockwise seen from outside.
    pub next: u16,
    /// The face to its left.
    pub face: u16,
}

/// The half-edges of a closed polyhedron. Immutable; indices are stable, and feature ids are made from them.
///
/// ```
/// use asunder::Cuboid;
/// let topology = Cuboid::topology();
/// let (vertices, edges, faces) = (8, topology.edges().len(), topology.face_count());
/// assert_eq!(vertices + faces - edges, 2, "Euler's formula");
/// assert_eq!(topology.face_vertices(1).collect::<Vec<_>>(), [1, 3, 7, 5]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    half_edges: Box<[HalfEdge]>,
    first_of_face: Box<[u16]>,
    /// Half-edges sorted by origin.
    by_origin: Box<[u16]>,
    /// Where those of each vertex begin; a last element for the end of all.
    first_of_vertex: Box<[u16]>,
    edges: Box<[u16]>,
}

impl Topology {
    /// The twin of a half-edge without one, which only a surface that is not closed has.
    pub(crate) const NO_TWIN: u16 = u16::MAX;

    /// Joins face loops, counter-clockwise seen from outside, into half-edges.
    pub(crate) fn from_loops<'a, Vertex: Copy + Into<u32> + 'a>(
        loops: impl Iterator<Item = &'a [Vertex]>,
    ) -> Self {
        let faces = loops.size_hint().0;
        let mut half_edges: Vec<HalfEdge> = Vec::with_capacity(4 * faces);
        let mut first_of_face = Vec::with_capacity(faces);
        for (face, vertices) in loops.enumerate() {
            let first = half_edges.len();
            first_of_face.push(first as u16);
            for (i, &origin) in vertices.iter().enumerate() {
                let next = first + (i + 1) % vertices.len();
                half_edges.push(HalfEdge {
                    origin: origin.into() as u16,
                    twin: Self::NO_TWIN,
                    next: next as u16,
                    face: face as u16,
                });
            }
        }
        // Finds twins by sorting half-edges by their undirected edge, which puts the two of an edge side by side. The
        // key is packed into one number.
        let undirected = |(i, h): (usize, &HalfEdge)| {
            let (from, to) = (h.origin, half_edges[h.next as usize].origin);
            u64::from(from.min(to)) << 32 | u64::from(from.max(to)) << 16 | i as u64
        };
        let mut order: Vec<u64> = half_edges.iter().enumerate().map(undirected).collect();
        order.sort_unstable();
        for two in order.windows(2) {
            if two[0] >> 16 == two[1] >> 16 {
                let [first, second] = [two[0] as u16, two[1] as u16];
                half_edges[usize::from(first)].twin = second;
                half_edges[usize::from(second)].twin = first;
            }
        }
        let edges = (0..half_edges.len() as u16).filter(|&i| i < half_edges[i as usize].twin).collect();
        let (by_origin, first_of_vertex) = by_origin(&half_edges);
        Self {
            half_edges: half_edges.into(),
            first_of_face: first_of_face.into(),
            by_origin,
            first_of_vertex,
            edges,
        }
    }

    /// One vertex, whose face loop never leaves it.
    pub(crate) fn point() -> &'static Self {
        static POINT: LazyLock<Topology> = LazyLock::new(|| Topology {
            half_edges: Box::new([HalfEdge { origin: 0, twin: 0, next: 0, face: 0 }]),
            first_of_face: Box::new([0]),
            by_origin: Box::new([0]),
            first_of_vertex: Box::new([0, 1]),
            edges: Box::new([]),
        });
        &POINT
    }

    /// Two vertices and the edge between them, with one face loop there and back.
    pub(crate) fn segment() -> &'static Self {
        static SEGMENT: LazyLock<Topology> =
            LazyLock::new(|| Topology::from_loops(core::iter::once([0_u16, 1].as_slice())));
        &SEGMENT
    }

    /// All half-edges, face after face.
    #[inline]
    pub fn half_edges(&self) -> &[HalfEdge] {
        &self.half_edges
    }

    /// One half-edge index for each edge, the lower of the two, ascending. It is also the edge's feature index.
    #[inline]
    pub fn edges(&self) -> &[u16] {
        &self.edges
    }

    /// Number of faces.
    #[inline]
    pub fn face_count(&self) -> usize {
        self.first_of_face.len()
    }

    /// Half-edge indices around a face. The face must be below [`Topology::face_count`].
    #[inline]
    pub fn face_half_edges(&self, face: usize) -> core::ops::Range<usize> {
        let first = self.first_of_face[face] as usize;
        let end = self.first_of_face.get(face + 1).map_or(self.half_edges.len(), |&e| e as usize);
        first..end
    }

    /// Vertex indices around a face, counter-clockwise seen from outside.
    #[inline]
    pub fn face_vertices(&self, face: usize) -> impl ExactSizeIterator<Item = usize> + Clone + '_ {
        self.half_edges[self.face_half_edges(face)].iter().map(|h| h.origin as usize)
    }

    /// The half-edges that leave a vertex, ascending. They lead to its neighbours, one in every face at the vertex.
    /// None for a vertex that does not exist.
    ///
    /// ```
    /// use asunder::Cuboid;
    /// let topology = Cuboid::topology();
    /// let mut neighbours: Vec<_> = topology.leaving(0).iter().map(|&h| topology.ends(h.into()).1).collect();
    /// neighbours.sort();
    /// assert_eq!(neighbours, [1, 2, 4], "corners that differ in one bit");
    /// ```
    #[inline]
    pub fn leaving(&self, vertex: usize) -> &[u16] {
        let Some(&[first, end]) = self.first_of_vertex.get(vertex..vertex + 2) else { return &[] };
        self.by_origin.get(usize::from(first)..usize::from(end)).unwrap_or_default()
    }

    /// The two vertices of a half-edge: its origin and where it leads.
    #[inline]
    pub fn ends(&self, half_edge: usize) -> (usize, usize) {
        let h = self.half_edges[half_edge];
        (h.origin as usize, self.half_edges[h.next as usize].origin as usize)
    }

    /// The lower half-edge index of the edge that this half-edge belongs to: the edge's feature index.
    #[inline]
    pub fn edge_of(&self, half_edge: usize) -> usize {
        half_edge.min(self.half_edges[half_edge].twin as usize)
    }
}

/// Half-edges sorted by origin, then by number; and where those of each vertex begin, with a last element for the end
/// of all.
fn by_origin(half_edges: &[HalfEdge]) -> (Box<[u16]>, Box<[u16]>) {
    let vertices = half_edges.iter().map(|h| usize::from(h.origin) + 1).max().unwrap_or(0);
    // A counting sort.
    let mut first = vec![0_u16; vertices + 1];
    for half_edge in half_edges {
        first[usize::from(half_edge.origin) + 1] += 1;
    }
    for vertex in 0..vertices {
        first[vertex + 1] += first[vertex];
    }
    let (mut order, mut next) = (vec![0_u16; half_edges.len()], first.clone());
    for (number, half_edge) in (0..).zip(half_edges) {
        let place = &mut next[usize::from(half_edge.origin)];
        order[usize::from(*place)] = number;
        *place += 1;
    }
    (order.into(), first.into())
}
