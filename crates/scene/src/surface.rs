//! Exact intersection with mirror surfaces, in f64.

use glam::{DMat3, DVec2, DVec3};

use crate::mesh::Mesh;
use crate::mirror::{Shape, SurfaceHit};
use crate::saddle::Patch;
use crate::torus;

impl Shape {
    /// Nearest hit with `t > t_min` of the ray `origin + t · dir` (`dir` of unit length), from
    /// either side; the normal is always that of the reflecting side, so a hit from behind has
    /// `dir · normal ≥ 0`. `None` for [`Shape::Mesh`], which has no analytic surface.
    pub fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit> {
        match self {
            Self::Sphere { center, radius } => {
                let roots = sphere_roots((origin - *center) / *radius, dir / *radius)?;
                let t = roots.into_iter().find(|t| *t > t_min)?;
                let normal = (origin + t * dir - *center).normalize();
                Some(SurfaceHit {
                    t,
                    position: *center + *radius * normal,
                    normal,
                })
            }
            Self::Ellipsoid {
                center,
                radii,
                rotation,
            } => {
                let to_local = rotation.transpose();
                let local_origin = to_local * (origin - *center) / *radii;
                let local_dir = to_local * dir / *radii;
                let t = sphere_roots(local_origin, local_dir)?
                    .into_iter()
                    .find(|t| *t > t_min)?;
                let on_unit = (local_origin + t * local_dir).normalize();
                let position = *center + *rotation * (on_unit * *radii);
                Some(SurfaceHit {
                    t,
                    position,
                    normal: (*rotation * (on_unit / *radii)).normalize(),
                })
            }
            Self::Plane {
                center,
                normal,
                up,
                size,
            } => {
                let towards = dir.dot(*normal);
                if towards == 0.0 {
                    return None;
                }
                let t = (*center - origin).dot(*normal) / towards;
                if t.is_nan() || t <= t_min || t.is_infinite() {
                    return None;
                }
                let offset = origin + t * dir - *center;
                let (x, y) = (offset.dot(up.cross(*normal)), offset.dot(*up));
                let inside = x.abs() <= size.x / 2.0 && y.abs() <= size.y / 2.0;
                let position = *center + offset - offset.dot(*normal) * *normal;
                inside.then_some(SurfaceHit {
                    t,
                    position,
                    normal: *normal,
                })
            }
            Self::Bowl {
                center,
                radius,
                axis,
                half_angle,
            } => {
                let rim = half_angle.cos();
                sphere_roots((origin - *center) / *radius, dir / *radius)?
                    .into_iter()
                    .filter(|t| *t > t_min)
                    .map(|t| (t, (origin + t * dir - *center).normalize()))
                    .find(|(_, outward)| outward.dot(*axis) >= rim)
                    .map(|(t, outward)| SurfaceHit {
                        t,
                        position: *center + *radius * outward,
                        normal: -outward,
                    })
            }
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => {
                let start = origin - *center;
                let t = torus::roots(start, dir, *axis, *major, *minor)
                    .iter()
                    .find(|t| *t > t_min)?;
                let point = start + t * dir;
                let (off, normal) = torus::distance(point, *axis, *major, *minor);
                Some(SurfaceHit {
                    t,
                    position: *center + (point - off * normal),
                    normal,
                })
            }
            Self::Saddle {
                center,
                normal,
                up,
                size,
                curvature,
            } => {
                let (frame, patch) = saddle(*normal, *up, *size, *curvature);
                let local = frame.transpose() * (origin - *center);
                let local_dir = frame.transpose() * dir;
                let t = patch.roots(local, local_dir).find(|t| *t > t_min)?;
                let at = (local + t * local_dir).truncate();
                Some(SurfaceHit {
                    t,
                    position: *center + frame * patch.point(at),
                    normal: frame * patch.normal(at),
                })
            }
            Self::Mesh(_) => None,
        }
    }

    /// Unit normal of the reflecting side at a point on the surface (for a point beside it: of
    /// the similar surface through it). `None` for [`Shape::Mesh`].
    pub fn normal_at(&self, point: DVec3) -> Option<DVec3> {
        match self {
            Self::Sphere { center, .. } => Some((point - *center).normalize()),
            Self::Ellipsoid {
                center,
                radii,
                rotation,
            } => {
                let local = rotation.transpose() * (point - *center);
                Some((*rotation * (local / (*radii * *radii))).normalize())
            }
            Self::Plane { normal, .. } => Some(*normal),
            Self::Bowl { center, .. } => Some((*center - point).normalize()),
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => Some(torus::distance(point - *center, *axis, *major, *minor).1),
            Self::Saddle {
                center,
                normal,
                up,
                size,
                curvature,
            } => {
                let (frame, patch) = saddle(*normal, *up, *size, *curvature);
                let at = (frame.transpose() * (point - *center)).truncate();
                Some(frame * patch.normal(at))
            }
            Self::Mesh(_) => None,
        }
    }

    /// True where the surface is known exactly and [`Shape::intersect`] works.
    pub fn is_analytic(&self) -> bool {
        !matches!(self, Self::Mesh(_))
    }

    /// True where the surface bounds a volume, so that its back is never seen from outside.
    /// A mesh is closed if each edge joins exactly two triangles (found anew at every call).
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Sphere { .. } | Self::Ellipsoid { .. } | Self::Torus { .. } => true,
            Self::Plane { .. } | Self::Bowl { .. } | Self::Saddle { .. } => false,
            Self::Mesh(mesh) => mesh.is_closed(),
        }
    }

    /// True where no point can have more than one reflection point: sphere, ellipsoid, plane.
    /// False for bowls, tori and saddles, and for meshes, of which it is not known.
    pub fn is_convex(&self) -> bool {
        matches!(
            self,
            Self::Sphere { .. } | Self::Ellipsoid { .. } | Self::Plane { .. }
        )
    }

    /// True for a point strictly inside a closed surface.
    pub fn contains(&self, point: DVec3) -> bool {
        match self {
            Self::Sphere { center, radius } => point.distance(*center) < *radius,
            Self::Ellipsoid {
                center,
                radii,
                rotation,
            } => (rotation.transpose() * (point - *center) / *radii).length() < 1.0,
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => torus::distance(point - *center, *axis, *major, *minor).0 < 0.0,
            Self::Plane { .. } | Self::Bowl { .. } | Self::Saddle { .. } => false,
            Self::Mesh(mesh) => mesh.is_closed() && mesh.winding_number(point).abs() > 0.5,
        }
    }

    /// The mirror's centre, from where environment maps are taken: of the sphere for a bowl, of
    /// the bounding box for a mesh.
    pub fn center(&self) -> DVec3 {
        match self {
            Self::Sphere { center, .. }
            | Self::Ellipsoid { center, .. }
            | Self::Plane { center, .. }
            | Self::Bowl { center, .. }
            | Self::Torus { center, .. }
            | Self::Saddle { center, .. } => *center,
            Self::Mesh(mesh) => mesh.bounds().map_or(DVec3::ZERO, |(low, high)| {
                (low.as_dvec3() + high.as_dvec3()) / 2.0
            }),
        }
    }

    /// Corners of the smallest axis-parallel box around the surface (for a bowl: around its
    /// whole sphere).
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let around = |center: DVec3, half: DVec3| (center - half, center + half);
        match self {
            Self::Sphere { center, radius } | Self::Bowl { center, radius, .. } => {
                around(*center, DVec3::splat(*radius))
            }
            Self::Ellipsoid {
                center,
                radii,
                rotation,
            } => {
                let axes = *rotation * DMat3::from_diagonal(*radii);
                let rows = axes.transpose();
                let half = DVec3::new(
                    rows.x_axis.length(),
                    rows.y_axis.length(),
                    rows.z_axis.length(),
                );
                around(*center, half)
            }
            Self::Plane {
                center,
                normal,
                up,
                size,
            } => {
                let half = (up.cross(*normal) * size.x / 2.0).abs() + (*up * size.y / 2.0).abs();
                around(*center, half)
            }
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => {
                let across = (DVec3::ONE - *axis * *axis).max(DVec3::ZERO);
                let across = DVec3::new(across.x.sqrt(), across.y.sqrt(), across.z.sqrt());
                around(*center, *major * across + *minor)
            }
            Self::Saddle {
                center,
                normal,
                up,
                size,
                curvature,
            } => {
                let (frame, patch) = saddle(*normal, *up, *size, *curvature);
                let [low, high] = patch.heights();
                let half = patch.half.extend((high - low) / 2.0);
                let half = frame.x_axis.abs() * half.x
                    + frame.y_axis.abs() * half.y
                    + frame.z_axis.abs() * half.z;
                around(*center + *normal * (low + high) / 2.0, half)
            }
            Self::Mesh(mesh) => mesh
                .bounds()
                .map_or((DVec3::ZERO, DVec3::ZERO), |(low, high)| {
                    (low.as_dvec3(), high.as_dvec3())
                }),
        }
    }
}

/// A saddle's axes (right, up, normal) and its patch in them.
pub(crate) fn saddle(normal: DVec3, up: DVec3, size: DVec2, curvature: DVec2) -> (DMat3, Patch) {
    let frame = DMat3::from_cols(up.cross(normal), up, normal);
    let half = size / 2.0;
    (frame, Patch { half, curvature })
}

/// Both roots, ascending, of `|origin + t · dir| = 1`; `None` where the line misses.
///
/// The discriminant comes from the line's distance to the centre and the smaller root from the
/// product of both, so neither cancels for far origins or origins on the surface.
fn sphere_roots(origin: DVec3, dir: DVec3) -> Option<[f64; 2]> {
    let a = dir.length_squared();
    let b = origin.dot(dir);
    let nearest = origin - dir * (b / a);
    let inside = 1.0 - nearest.length_squared();
    if inside.is_nan() || inside < 0.0 {
        return None;
    }
    let distance = origin.length();
    let c = (distance - 1.0) * (distance + 1.0);
    let q = -(b + (a * inside).sqrt().copysign(b));
    let (first, second) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
    Some(if first <= second {
        [first, second]
    } else {
        [second, first]
    })
}

impl Mesh {
    /// Corners of the smallest axis-parallel box around all positions; `None` without positions.
    pub fn bounds(&self) -> Option<(glam::Vec3, glam::Vec3)> {
        let first = *self.positions.first()?;
        Some(
            self.positions
                .iter()
                .fold((first, first), |(low, high), p| (low.min(*p), high.max(*p))),
        )
    }

    /// True where each edge joins exactly two triangles of opposite edge direction.
    pub fn is_closed(&self) -> bool {
        let mut edges = std::collections::HashMap::new();
        for &[a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (key, sign) = if from < to {
                    ((from, to), 1i64)
                } else {
                    ((to, from), -1)
                };
                let (count, sum) = edges.entry(key).or_insert((0u32, 0i64));
                *count += 1;
                *sum += sign;
            }
        }
        !edges.is_empty() && edges.values().all(|(count, sum)| *count == 2 && *sum == 0)
    }

    /// How often the surface winds around a point: ±1 inside a closed surface, 0 outside.
    pub fn winding_number(&self, point: DVec3) -> f64 {
        let solid_angle = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| self.positions[i as usize].as_dvec3() - point);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let numerator = a.dot(b.cross(c));
            let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * numerator.atan2(denominator)
        };
        self.triangles.iter().map(solid_angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
    }
}
