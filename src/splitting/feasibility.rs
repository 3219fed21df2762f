//! Measures of a patch that do not depend on its flat state: curvature, coverage of its peaks,
//! longest geodesic, diagonals.

use super::{Coverage, coverage};
use crate::cladding::Maps;
use crate::geodesic::{GeodesicError, Geodesics};
use crate::layout::{Domain, vertices_inside};
use crate::surface::curvature::{BORDER_RINGS, Curvature, PeakOptions, peaks};
use crate::surface::{Mesh, Point3, SurfacePoint};
use serde::{Deserialize, Serialize};

/// What speaks for and against a patch before it is clad.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Feasibility {
    /// Largest Gaussian curvature inside, 1/m².
    pub curvature_max: f64,
    /// Where it is.
    pub peak: Point3,
    /// The significant peaks, highest first.
    pub peaks: Vec<JudgedPeak>,
    /// The longest shortest geodesic between opposite sides, metres.
    pub longest: f64,
    /// Diagonals A-C and B-D on the surface, metres.
    pub diagonals: [f64; 2],
    /// Halfway between the middles of the sides AB and DC.
    pub centre: Point3,
}

/// A significant peak of curvature and how the families cover it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct JudgedPeak {
    /// Where it is.
    pub place: Point3,
    /// Gaussian curvature, 1/m².
    pub gaussian: f64,
    /// By the u- and the v-family.
    pub coverage: [Coverage; 2],
}

impl JudgedPeak {
    /// η of the u- and the v-family.
    pub fn eta(&self) -> [f64; 2] {
        self.coverage.map(|cover| cover.eta)
    }
}

impl Feasibility {
    /// Largest η of the u- and the v-family over all peaks; 1 where there is none.
    pub fn eta(&self) -> [f64; 2] {
        let etas = self.peaks.iter().map(JudgedPeak::eta);
        etas.fold([1.0, 1.0], |[u, v]: [f64; 2], eta| {
            [u.max(eta[0]), v.max(eta[1])]
        })
    }

    /// π / sqrt(K): shorter geodesics are unique (paper, Expression 1). `None` where the patch is
    /// nowhere domed, so that all are.
    pub fn injectivity_bound(&self) -> Option<f64> {
        (self.curvature_max > 0.0).then(|| std::f64::consts::PI / self.curvature_max.sqrt())
    }
}

/// Measures a patch. `mesh` and `curvature` are those of the whole surface, of which the domain is
/// a part; `maps` are the distance maps of the patch, `slope` the bounds of cladding functions.
pub fn feasibility(
    mesh: &Mesh,
    curvature: &Curvature,
    domain: &Domain,
    maps: &Maps<'_>,
    slope: [f64; 2],
) -> Result<Feasibility, GeodesicError> {
    let region: Vec<u32> = vertices_inside(domain.mesh(), &domain.ring(), domain.turns_left())
        .into_iter()
        .map(|vertex| domain.part.vertex_to_parent(vertex))
        .collect();
    let [a, b, c, d] = domain.corners();
    let highest = highest(mesh, curvature, &region, domain.part.point_to_parent(&a));
    let geodesics = Geodesics::new(domain.mesh());
    let mut judged = Vec::new();
    for peak in peaks(mesh, curvature, &region, PeakOptions::default()) {
        // A curvature peak on the rim of the patch has no two sides of it to be passed on.
        let in_part = domain.part.vertex_from_parent(peak.vertex);
        let Some(vertex) = in_part.filter(|_| !peak.on_rim) else {
            continue;
        };
        let at = SurfacePoint::Vertex(vertex);
        judged.push(JudgedPeak {
            place: mesh.position(peak.vertex),
            gaussian: peak.gaussian,
            coverage: coverage(domain, &geodesics, &at, [maps.u, maps.v], slope)?,
        });
    }
    let middle = |side: &crate::layout::Side| side.at(domain.mesh(), 0.5);
    let across = geodesics.shortest(&middle(&domain.ab), &middle(&domain.dc))?;
    let halfway = across.point_at(domain.mesh(), 0.5 * across.length);
    Ok(Feasibility {
        curvature_max: highest.0,
        peak: highest.1.position(mesh),
        peaks: judged,
        longest: maps.u.longest().max(maps.v.longest()),
        diagonals: [
            geodesics.shortest(&a, &c)?.length,
            geodesics.shortest(&b, &d)?.length,
        ],
        centre: halfway.position(domain.mesh()),
    })
}

/// The largest curvature of a region; of the corner A where no vertex lies inside.
fn highest(
    mesh: &Mesh,
    curvature: &Curvature,
    region: &[u32],
    a: SurfacePoint,
) -> (f64, SurfacePoint) {
    let rings = mesh.rings_from_border(BORDER_RINGS);
    let at_a = (curvature.gaussian_at(mesh, &a), a);
    region
        .iter()
        .filter(|&&v| rings[v as usize] > BORDER_RINGS)
        .map(|&v| (curvature.vertex(v).gaussian(), SurfacePoint::Vertex(v)))
        .reduce(|best, next| if next.0 > best.0 { next } else { best })
        .unwrap_or(at_a)
}
