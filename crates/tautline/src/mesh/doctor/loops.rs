//! Open edges, one after another.

use crate::order::PutInOrder;

/// Open edges that follow each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Chain {
    /// The vertices along them; of a loop, the first is not repeated.
    pub(super) vertices: Vec<u32>,
    pub(super) is_loop: bool,
}

/// Groups edges into loops that meet no vertex twice, and into chains where no loop closes. Each begins with its lowest
/// edge and runs as that does.
pub(super) fn chains(edges: &[[u32; 2]], vertex_count: usize) -> Vec<Chain> {
    let mut at_vertex: Vec<(u32, u32)> =
        edges.iter().zip(0..).flat_map(|(&[a, b], edge)| [(a, edge), (b, edge)]).collect();
    at_vertex.put_in_order();
    // The first of a vertex's edges that may not have been walked along.
    let mut next_at = vec![0; vertex_count];
    at_vertex.iter().enumerate().rev().for_each(|(i, &(vertex, _))| next_at[vertex as usize] = i);
    let mut is_used = vec![false; edges.len()];
    // Where a vertex stands on the path, if it does.
    let mut place = vec![usize::MAX; vertex_count];
    let mut chains = Vec::new();
    for first in 0..edges.len() {
        if is_used[first] {
            continue;
        }
        let mut path = vec![edges[first][0]];
        place[path[0] as usize] = 0;
        let mut step = Some(first as u32);
        while let Some(edge) = step {
            is_used[edge as usize] = true;
            let here = path[path.len() - 1];
            let [a, b] = edges[edge as usize];
            let next = if a == here { b } else { a };
            match place[next as usize] {
                usize::MAX => {
                    place[next as usize] = path.len();
                    path.push(next);
                }
                start => {
                    let vertices = path[start..].to_vec();
                    path.drain(start + 1..).for_each(|vertex| place[vertex as usize] = usize::MAX);
                    chains.push(Chain { vertices, is_loop: true });
                }
            }
            step = unused_at(&at_vertex, &mut next_at, &is_used, path[path.len() - 1]);
        }
        path.iter().for_each(|&vertex| place[vertex as usize] = usize::MAX);
        if path.len() > 1 {
            chains.push(Chain { vertices: path, is_loop: false });
        }
    }
    chains
}

/// The lowest edge at a vertex that has not been walked along.
fn unused_at(at_vertex: &[(u32, u32)], next_at: &mut [usize], is_used: &[bool], vertex: u32) -> Option<u32> {
    let next = &mut next_at[vertex as usize];
    while let Some(&(_, edge)) = at_vertex.get(*next).filter(|&&(at, _)| at == vertex) {
        if !is_used[edge as usize] {
            return Some(edge);
        }
        *next += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_that_touch_are_told_apart_and_chains_end() {
        let edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 2], [7, 6], [6, 5]];
        let found = chains(&edges, 8);
        let expected = [(vec![0, 1, 2], true), (vec![2, 3, 4], true), (vec![7, 6, 5], false)];
        let mut found: Vec<_> = found.into_iter().map(|chain| (chain.vertices, chain.is_loop)).collect();
        found.sort_unstable_by_key(|(vertices, _)| vertices.iter().sum::<u32>());
        assert_eq!(found.len(), 3);
        for (chain, expected) in found.iter().zip(&expected) {
            assert_eq!(chain.1, expected.1);
            let mut vertices = chain.0.clone();
            vertices.sort_unstable();
            let mut wanted = expected.0.clone();
            wanted.sort_unstable();
            assert_eq!(vertices, wanted);
        }
    }
}
