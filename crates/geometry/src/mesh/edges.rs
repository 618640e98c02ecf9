//! Pairs the half-edges of a mesh.

/// The neighbours of all triangles, and the duplicates found on the way.
pub(super) struct Edges {
    /// For each half-edge, three per triangle, the one on the other side.
    pub(super) twins: Vec<u32>,
    /// How many triangles were dropped as duplicates of others.
    pub(super) duplicate: usize,
    /// Whether one of these is the back of another: the same three vertices, wound the other way.
    pub(super) has_backs: bool,
}

/// The twin of a half-edge beyond which there is no triangle, or no unique one.
pub(super) const NO_TWIN: u32 = u32::MAX;

impl Edges {
    /// Pairs half-edges, and drops triangles with the same three vertices as an earlier one: these share an edge with
    /// it and the opposite vertex. With `keeps_backs`, backs are kept: a sheet with fronts and backs is then two
    /// sheets, connected along its rim.
    ///
    /// Works by sorting: a counting sort of half-edges by their lesser vertex, then a sort by the greater one.
    pub(super) fn of(
        triangles: &[[u32; 3]],
        vertices: usize,
        is_dropped: &mut [bool],
        keeps_backs: bool,
    ) -> Self {
        let twins = vec![NO_TWIN; 3 * triangles.len()];
        let mut pairing =
            Pairing { triangles, twins, duplicate: 0, has_backs: false, is_dropped, keeps_backs };
        let (mut half_edges, ends) = pairing.by_lesser_vertex(vertices);
        let mut start = 0;
        for end in ends {
            let at_vertex = &mut half_edges[start..end as usize];
            at_vertex.sort_unstable();
            at_vertex.chunk_by_mut(|one, other| one >> 32 == other >> 32).for_each(|edge| pairing.pair(edge));
            start = end as usize;
        }
        Self { twins: pairing.twins, duplicate: pairing.duplicate, has_backs: pairing.has_backs }
    }
}

struct Pairing<'a> {
    triangles: &'a [[u32; 3]],
    twins: Vec<u32>,
    duplicate: usize,
    has_backs: bool,
    is_dropped: &'a mut [bool],
    keeps_backs: bool,
}

impl Pairing<'_> {
    /// The start and end of a half-edge, and the opposite vertex.
    fn vertices(&self, half_edge: u32) -> [u32; 3] {
        let [a, b, c] = self.triangles[half_edge as usize / 3];
        match half_edge % 3 {
            0 => [a, b, c],
            1 => [b, c, a],
            _ => [c, a, b],
        }
    }

    /// Half-edges sorted by their lesser vertex, with the greater one in the upper half of each number; and where those
    /// of each vertex end.
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
        // By now every place has advanced to the end of its half-edges.
        (sorted, places)
    }

    /// Pairs the half-edges of one edge, which come in the order of their numbers.
    fn pair(&mut self, edge: &mut [u64]) {
        let opposite = |half_edge: u64| self.vertices(half_edge as u32)[2];
        edge.sort_unstable_by_key(|&half_edge| (opposite(half_edge), half_edge));
        // For the first two opposite vertices, a half-edge in each direction.
        let mut different = [[NO_TWIN; 2]; 2];
        let (mut count, mut last, mut seen) = (0, None, [false; 2]);
        for &half_edge in &*edge {
            let half_edge = half_edge as u32;
            let [from, to, opposite] = self.vertices(half_edge);
            let way = usize::from(from > to);
            if last.replace(opposite) != Some(opposite) {
                (count, seen) = (count + 1, [false; 2]);
            }
            let [is_repeated, is_back] = [seen[way], !seen[way] && seen[1 - way]];
            seen[way] = true;
            if is_repeated || is_back && !self.keeps_backs {
                let is_dropped = &mut self.is_dropped[half_edge as usize / 3];
                self.duplicate += usize::from(!*is_dropped);
                self.has_backs |= is_back;
                *is_dropped = true;
                continue;
            }
            if let Some(different) = different.get_mut(count - 1) {
                different[way] = half_edge;
            }
        }
        let [[up, down], others] = different;
        let pairs = match count {
            1 => [[up, down], [NO_TWIN; 2]],
            2 => [[up, others[1]], [down, others[0]]],
            _ => return,
        };
        for [one, other] in pairs.into_iter().filter(|pair| !pair.contains(&NO_TWIN)) {
            self.twins[one as usize] = other;
            self.twins[other as usize] = one;
        }
    }
}
