//! The distances and paths from one source.

use super::path::Path;
use super::solve::{Approach, Swept};
use super::trace::Tracer;
use super::{GeodesicError, Geodesics, Reach};
use crate::surface::{SurfacePoint, Tangent};

/// Distances and paths from one source, as far as the field was asked to reach.
pub struct Field<'g> {
    geodesics: &'g Geodesics<'g>,
    source: SurfacePoint,
    swept: Swept,
}

/// How a shortest path leaves its source and arrives at its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// Metres.
    pub length: f64,
    /// Direction in which the path leaves the source.
    pub start: Tangent,
    /// Direction in which the path arrives, pointing onward.
    pub end: Tangent,
}

impl Arrival {
    pub(super) fn of(path: &Path) -> Self {
        Self {
            length: path.length,
            start: path.start,
            end: path.end,
        }
    }
}

/// What a field knows of a point.
struct Known {
    point: SurfacePoint,
    distance: f64,
    approach: Approach,
}

impl<'g> Field<'g> {
    pub(super) fn new(geodesics: &'g Geodesics<'g>, source: SurfacePoint, swept: Swept) -> Self {
        Self {
            geodesics,
            source,
            swept,
        }
    }

    /// The source.
    pub fn source(&self) -> SurfacePoint {
        self.source
    }

    /// Distance of a vertex, metres; `None` beyond the reach of the field or in another component.
    pub fn vertex_distance(&self, vertex: u32) -> Option<f64> {
        let distance = *self.swept.distances.get(vertex as usize)?;
        (distance <= self.swept.horizon && distance.is_finite()).then_some(distance)
    }

    /// Distance of any point, metres.
    ///
    /// Vertices and the targets that the field was solved for cost nothing; another point is
    /// solved for anew.
    pub fn distance(&self, point: &SurfacePoint) -> Result<f64, GeodesicError> {
        let point = self.geodesics.checked(point)?;
        match self.known(point)? {
            Some(known) => Ok(known.distance),
            None => self.solved_for(point)?.distance(&point),
        }
    }

    /// The shortest path to a point. Costs as `distance`, and time in proportion to its crossings.
    pub fn path_to(&self, point: &SurfacePoint) -> Result<Path, GeodesicError> {
        let point = self.geodesics.checked(point)?;
        match self.known(point)? {
            Some(known) => self.trace(&known),
            None => self.solved_for(point)?.path_to(&point),
        }
    }

    /// Length and end directions of the shortest path to a point; their angles with a direction
    /// of motion are the gradient of the distance (see [`derivative_along`]). Costs as `path_to`.
    ///
    /// [`derivative_along`]: super::derivative_along
    pub fn arrival(&self, point: &SurfacePoint) -> Result<Arrival, GeodesicError> {
        Ok(Arrival::of(&self.path_to(point)?))
    }

    /// What is known of a checked point; `None` if the field was not solved for it.
    fn known(&self, point: SurfacePoint) -> Result<Option<Known>, GeodesicError> {
        let swept = &self.swept;
        let found = match point {
            _ if point == self.source => Some((0.0, Approach::NONE)),
            SurfacePoint::Vertex(v) => {
                Some((swept.distances[v as usize], swept.approaches[v as usize]))
            }
            _ => {
                let target = swept.targets.iter().find(|t| t.point == point);
                target.map(|t| (t.distance, t.approach))
            }
        };
        let Some((distance, approach)) = found else {
            return Ok(None);
        };
        if distance.is_finite() && distance <= swept.horizon {
            Ok(Some(Known {
                point,
                distance,
                approach,
            }))
        } else if swept.horizon.is_finite() {
            Err(GeodesicError::BeyondReach { target: point })
        } else {
            Err(GeodesicError::Unreachable { target: point })
        }
    }

    /// The field of the same source, solved for one more point within the same reach.
    fn solved_for(&self, point: SurfacePoint) -> Result<Field<'g>, GeodesicError> {
        let reach = Reach::Targets(std::slice::from_ref(&point));
        let field = self.geodesics.field(&self.source, reach)?;
        match field.distance(&point)? {
            distance if distance > self.swept.horizon => {
                Err(GeodesicError::BeyondReach { target: point })
            }
            _ => Ok(field),
        }
    }

    fn trace(&self, known: &Known) -> Result<Path, GeodesicError> {
        let point = known.point;
        if known.distance <= 0.0 {
            return Err(GeodesicError::Coincident { point });
        }
        let tracer = Tracer {
            mesh: self.geodesics.mesh,
            charts: &self.geodesics.charts,
            source: &self.source,
            swept: &self.swept,
        };
        tracer
            .path(point, known.distance, known.approach)
            .ok_or(GeodesicError::Untraceable { target: point })
    }
}
