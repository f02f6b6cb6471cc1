//! Bounding spheres of bodies.

use glam::Vec3;

use crate::body::Substance;
use crate::geometry::Sphere;
use crate::geometry::sphere_tree::Topology;
use crate::view::BodyView;

impl BodyView<'_> {
    /// The spheres of its sphere tree as it is now, each with its level, the root being 0: a truss's, or a cloth's or
    /// rope's, which the paper's solver searches. Empty for all else.
    pub fn spheres(&self) -> Vec<(Sphere, u32)> {
        let (body, positions) = (self.body(), self.positions());
        match &body.substance {
            Substance::Truss { truss } => {
                let tree = truss.tree();
                with_levels(tree.topology(), |node| tree.sphere(node, positions))
            }
            Substance::Deformable(deformable) => {
                let mut tree = deformable.tree.clone();
                if tree.refit(positions).is_err() {
                    return Vec::new();
                }
                with_levels(tree.topology(), |node| tree.spheres()[node])
            }
            Substance::Rigid(_) | Substance::HalfSpace(_) => Vec::new(),
        }
    }

    /// The axis-aligned box around its surface, its lowest and its highest corner (m); `None` for a half-space.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let places = self.surface_positions();
        let first = *places.first()?;
        Some(places.iter().fold([first; 2], |[low, high], &place| [low.min(place), high.max(place)]))
    }
}

/// All spheres below the root, each with its level.
fn with_levels(topology: &Topology, sphere: impl Fn(usize) -> Sphere) -> Vec<(Sphere, u32)> {
    let (mut found, mut next) = (Vec::new(), vec![(0, 0)]);
    while let Some((node, level)) = next.pop().filter(|_| topology.node_count() > 0) {
        found.push((sphere(node), level));
        let children = topology.children(node).into_iter().flatten();
        next.extend(children.map(|child| (child, level + 1)));
    }
    found
}
