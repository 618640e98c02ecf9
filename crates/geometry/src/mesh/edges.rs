//! Which triangles meet at which edges.

/// What follows from who shares an edge with whom.
pub(super) struct Edges {
    /// For each half-edge, three a triangle, the one on the other side.
    pub(super) twins: Vec<u32>,
    /// How many triangles were dropped as others' duplicates.
    pub(super) duplicate: usize,
}

/// Twin of a half-edge beyond which there is nothing, or not one thing.
pub(super) const NO_TWIN: u32 = u32::MAX;

impl Edges {
    /// Pairs half-edges, and drops triangles that have the same three vertices as an earlier one: those share three
    /// edges with it, and at each the vertex on the other side.
    ///
    /// By sorting: half-edges go to the lesser of their vertices, by counting, and there stand in the order of the
    /// other.
    pub(super) fn of(triangles: &[[u32; 3]], vertices: usize, is_dropped: &mut [bool]) -> Self {
        let mut pairing =
            Pairing { triangles, twins: vec![NO_TWIN; 3 * triangles.len()], duplicate: 0, is_dropped };
        let (mut half_edges, ends) = pairing.by_lesser_vertex(vertices);
        let mut start = 0;
        for end in ends {
            let at_vertex = &mut half_edges[start..end as usize];
            at_vertex.sort_unstable();
            at_vertex.chunk_by_mut(|one, other| one >> 32 == other >> 32).for_each(|edge| pairing.pair(edge));
            start = end as usize;
        }
        Self { twins: pairing.twins, duplicate: pairing.duplicate }
    }
}

struct Pairing<'a> {
    triangles: &'a [[u32; 3]],
    twins: Vec<u32>,
    duplicate: usize,
    is_dropped: &'a mut [bool],
}

impl Pairing<'_> {
    /// Where a half-edge starts and ends, and the vertex that is not on it.
    fn vertices(&self, half_edge: u32) -> [u32; 3] {
        let [a, b, c] = self.triangles[half_edge as usize / 3];
        match half_edge % 3 {
            0 => [a, b, c],
            1 => [b, c, a],
            _ => [c, a, b],
        }
    }

    /// Half-edges with their greater vertex in the upper half, in the order of their lesser vertex; and where those of
    /// each vertex end.
    fn by_lesser_vertex(&self, vertices: usize) -> (Vec<u64>, Vec<u32>) {
        let kept = (0..self.triangles.len()).filter(|&triangle| !self.is_dropped[triangle]);
        let half_edges = kept.flat_map(|triangle| (3 * triangle as u32..).take(3));
        let ends = |half_edge: u32| {
            let [from, to, _] = self.vertices(half_edge);
            (from.min(to), from.max(to))
        };
        let mut places = vec![0_u32; vertices];
        half_edges.clone().for_each(|half_edge| places[ends(half_edge).0 as usize] += 1);
        let mut sum = 0;
        for place in &mut places {
            sum += core::mem::replace(place, sum);
        }
        let mut sorted = vec![0_u64; sum as usize];
        for half_edge in half_edges {
            let (lesser, greater) = ends(half_edge);
            let place = &mut places[lesser as usize];
            sorted[*place as usize] = u64::from(greater) << 32 | u64::from(half_edge);
            *place += 1;
        }
        // Every place has moved on to where its half-edges end.
        (sorted, places)
    }

    /// The half-edges of one edge, in the order of their numbers.
    fn pair(&mut self, edge: &mut [u64]) {
        let opposite = |half_edge: u64| self.vertices(half_edge as u32)[2];
        edge.sort_unstable_by_key(|&half_edge| (opposite(half_edge), half_edge));
        let mut different = [0_u32; 2];
        let mut count = 0;
        let mut last = None;
        for &half_edge in &*edge {
            let (half_edge, opposite) = (half_edge as u32, self.vertices(half_edge as u32)[2]);
            if last.replace(opposite) == Some(opposite) {
                let is_dropped = &mut self.is_dropped[half_edge as usize / 3];
                self.duplicate += usize::from(!*is_dropped);
                *is_dropped = true;
                continue;
            }
            if let Some(different) = different.get_mut(count) {
                *different = half_edge;
            }
            count += 1;
        }
        let [one, other] = different;
        if count == 2 && self.vertices(one)[0] != self.vertices(other)[0] {
            self.twins[one as usize] = other;
            self.twins[other as usize] = one;
        }
    }
}
