//! Feasibility of a patch: curvature, coverage of its peaks, diagonals.

use super::{Coverage, coverage};
use crate::cladding::Clad;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::cladding as codes;
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
    /// Coverage of each significant peak, highest first: by the u- and the v-family.
    pub coverage: Vec<[Coverage; 2]>,
    /// Places of these peaks.
    pub peaks: Vec<Point3>,
    /// Diagonals A-C and B-D on the surface, metres.
    pub diagonals: [f64; 2],
}

impl Feasibility {
    /// Largest η of the u- and the v-family over all peaks; 1 where there is none.
    pub fn eta(&self) -> [f64; 2] {
        [0, 1].map(|i| self.coverage.iter().map(|c| c[i].eta).fold(1.0, f64::max))
    }

    /// π / sqrt(K): shorter geodesics are unique (paper, Expression 1). `None` where the patch is
    /// nowhere domed, so that all are.
    pub fn injectivity_bound(&self) -> Option<f64> {
        (self.curvature_max > 0.0).then(|| std::f64::consts::PI / self.curvature_max.sqrt())
    }
}

/// Measures a patch. `mesh` and `curvature` are those of the whole surface, of which the domain is
/// a part.
pub fn feasibility(
    mesh: &Mesh,
    curvature: &Curvature,
    domain: &Domain,
) -> Result<Feasibility, GeodesicError> {
    let region: Vec<u32> = vertices_inside(domain.mesh(), &domain.ring(), domain.turns_left())
        .into_iter()
        .map(|vertex| domain.part.vertex_to_parent(vertex))
        .collect();
    let [a, b, c, d] = domain.corners();
    let highest = highest(mesh, curvature, &region, domain.part.point_to_parent(&a));
    let geodesics = Geodesics::new(domain.mesh());
    // A curvature peak on the rim of the patch has no two sides of it to be passed on.
    let significant: Vec<u32> = peaks(mesh, curvature, &region, PeakOptions::default())
        .into_iter()
        .filter(|peak| !peak.on_rim)
        .map(|peak| peak.vertex)
        .collect();
    let cover = |vertex: &u32| {
        let in_part = domain.part.vertex_from_parent(*vertex)?;
        Some(coverage(domain, &geodesics, &SurfacePoint::Vertex(in_part)))
    };
    Ok(Feasibility {
        curvature_max: highest.0,
        peak: highest.1.position(mesh),
        coverage: significant
            .iter()
            .filter_map(cover)
            .collect::<Result<_, _>>()?,
        peaks: significant
            .iter()
            .map(|&vertex| mesh.position(vertex))
            .collect(),
        diagonals: [
            geodesics.shortest(&a, &c)?.length,
            geodesics.shortest(&b, &d)?.length,
        ],
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

/// Warnings about a clad patch, by the largest feasible η.
pub fn judge(feasibility: &Feasibility, clad: &Clad, eta_max: f64) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    for (covers, place) in feasibility.coverage.iter().zip(&feasibility.peaks) {
        let exceed = |c: &Coverage| c.eta > eta_max;
        if !covers.iter().any(exceed) {
            continue;
        }
        let proposal = if covers.iter().all(exceed) {
            "put a corner on the peak: both families pass beside it"
        } else {
            "split the patch so that a side runs over the peak"
        };
        told.push(
            Diagnostic::warning(
                codes::UNCOVERED,
                format!(
                    "members pass beside the peak of curvature at ({:.4}, {:.4}, {:.4}) m: η is \
                     {:.4} for the u-family and {:.4} for the v-family, the limit {eta_max}",
                    place.x, place.y, place.z, covers[0].eta, covers[1].eta
                ),
            )
            .at_key("", "this patch")
            .help(proposal),
        );
    }
    let [e, f] = feasibility.diagonals;
    let [e_planar, f_planar] = clad.quad.diagonals();
    if (e - e_planar) * (f - f_planar) >= 0.0 {
        told.push(
            Diagnostic::warning(
                codes::DIAGONALS,
                format!(
                    "both diagonals change in the same direction: {e:.4} m to {e_planar:.4} m and \
                     {f:.4} m to {f_planar:.4} m when flat"
                ),
            )
            .at_key("", "this patch")
            .help("choose another `alpha`"),
        );
    }
    told
}
