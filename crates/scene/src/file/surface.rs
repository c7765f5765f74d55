//! What objects and mesh mirrors share: meshes, primitives, transforms.

use std::path::{Path, PathBuf};

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3, Vec3};

use super::origin::Origin;
use crate::document::{SMALLEST, Table, short};
use crate::geometry::{Geometry, Transform, rotation};
use crate::model::{self, Kind};
use crate::obj::{self, Materials};
use crate::{SceneError, primitives};

/// Triangles to be made or read.
pub(super) enum Surface {
    Quad,
    Grid {
        cells: u32,
    },
    Cuboid {
        cells: u32,
    },
    Sphere {
        center: DVec3,
        radius: f64,
        segments: u32,
    },
    Torus {
        radius: f64,
        tube: f64,
        segments: u32,
    },
    Lathe {
        profile: Vec<DVec2>,
        cells: u32,
        segments: u32,
        /// Radians.
        turn: f64,
    },
    Teapot {
        cells: u32,
    },
    Triangles {
        positions: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        /// One a triangle, or none.
        colors: Vec<Vec3>,
    },
    Mesh {
        file: String,
        mtl: Option<String>,
    },
}

/// Most copies of one object.
const MOST_COPIES: usize = 10_000;

/// Names of the primitives, for suggestions.
pub(super) const PRIMITIVES: [&str; 10] = [
    "quad",
    "grid",
    "box",
    "sphere",
    "torus",
    "lathe",
    "cylinder",
    "cone",
    "teapot",
    "triangles",
];

/// Keys of a primitive; `None` where there is no such primitive.
pub(super) fn primitive(table: &Table<'_>, shape: &str) -> Result<Option<Surface>, SceneError> {
    let cells = || table.count("n", 1..=2048);
    let segments =
        |default| Ok::<_, SceneError>(table.count("segments", 3..=4096)?.unwrap_or(default));
    Ok(Some(match shape {
        "quad" => Surface::Quad,
        "grid" => Surface::Grid {
            cells: cells()?.unwrap_or(8),
        },
        "box" => Surface::Cuboid {
            cells: cells()?.unwrap_or(1),
        },
        "sphere" => Surface::Sphere {
            center: table.vector("center")?.unwrap_or(DVec3::ZERO),
            radius: table.positive("radius")?.unwrap_or(1.0),
            segments: table.count("segments", 4..=4096)?.unwrap_or(32),
        },
        "torus" => {
            let radius = table.positive("radius")?.unwrap_or(1.0);
            let tube = table.positive("tube")?.unwrap_or(0.35);
            if tube >= radius {
                return Err(table.error("tube", "must be smaller than `radius`"));
            }
            Surface::Torus {
                radius,
                tube,
                segments: segments(48)?,
            }
        }
        "lathe" => {
            let rows = table.rows::<2>("profile")?;
            let (cells, segments) = (cells()?.unwrap_or(1), segments(32)?);
            let degrees = table.number("turn_deg")?.unwrap_or(360.0);
            if !(1e-3..=360.0).contains(&degrees) {
                let message =
                    format_args!("must be above 0 and at most 360, not {}", short(degrees));
                return Err(table.error("turn_deg", message));
            }
            let rows = table.required("profile", rows)?;
            if rows.len() < 2 || rows.iter().any(|[distance, _]| *distance < 0.0) {
                let message = "must be at least 2 pairs of distance ≥ 0 from the axis and height";
                return Err(table.error("profile", message));
            }
            if rows
                .windows(2)
                .any(|pair| pair[0] == pair[1] || pair[0][0].max(pair[1][0]) == 0.0)
            {
                return Err(table.error("profile", "has a side without area"));
            }
            Surface::Lathe {
                profile: rows.into_iter().map(DVec2::from).collect(),
                cells,
                segments,
                turn: degrees.to_radians(),
            }
        }
        "cylinder" | "cone" => {
            let top = if shape == "cone" {
                vec![(0.0, 1.0)]
            } else {
                vec![(1.0, 1.0), (0.0, 1.0)]
            };
            let profile = [(0.0, -1.0), (1.0, -1.0)]
                .into_iter()
                .chain(top)
                .map(DVec2::from)
                .collect();
            Surface::Lathe {
                profile,
                cells: cells()?.unwrap_or(1),
                segments: segments(32)?,
                turn: TAU,
            }
        }
        "teapot" => Surface::Teapot {
            cells: table.count("n", 1..=128)?.unwrap_or(8),
        },
        "triangles" => triangles(table)?,
        _ => return Ok(None),
    }))
}

/// Triangles written out.
fn triangles(table: &Table<'_>) -> Result<Surface, SceneError> {
    let positions = table.rows::<3>("positions")?;
    let triangles = table.count_rows::<3>("triangles", 0..=u32::MAX)?;
    let colors = table.rows::<3>("colors")?;
    let positions = table.required("positions", positions)?;
    let triangles = table.required("triangles", triangles)?;
    let count = positions.len();
    if let Some(index) = triangles
        .as_flattened()
        .iter()
        .find(|i| **i as usize >= count)
    {
        let message = format_args!("has index {index}, but there are {count} positions from 0");
        return Err(table.error("triangles", message));
    }
    let colors = colors.unwrap_or_default();
    if !colors.is_empty() && colors.len() != triangles.len() {
        let message = format_args!(
            "must be one for each of {} triangles, not {}",
            triangles.len(),
            colors.len()
        );
        return Err(table.error("colors", message));
    }
    if colors.as_flattened().iter().any(|channel| *channel < 0.0) {
        return Err(table.error("colors", "must not be negative"));
    }
    Ok(Surface::Triangles {
        positions: positions.into_iter().map(DVec3::from_array).collect(),
        triangles,
        colors: colors
            .into_iter()
            .map(|color| DVec3::from_array(color).as_vec3())
            .collect(),
    })
}

impl Surface {
    /// Triangles of a shape; `None` of a mesh, which has to be read to tell.
    fn triangle_count(&self) -> Option<u64> {
        let square = |cells: u32| 2 * u64::from(cells).pow(2);
        let around = |segments: u32, rows: u32| 2 * u64::from(segments) * u64::from(rows);
        Some(match self {
            Self::Quad => square(1),
            Self::Grid { cells } => square(*cells),
            Self::Cuboid { cells } => 6 * square(*cells),
            Self::Sphere { segments, .. } => around(*segments, (segments / 2).max(2) - 1),
            Self::Torus { segments, .. } => around(*segments, (segments / 2).max(3)),
            Self::Lathe {
                profile,
                cells,
                segments,
                ..
            } => {
                let poles = |side: &[DVec2]| side.iter().filter(|point| point.x == 0.0).count();
                let side = |side: &[DVec2]| {
                    around(*segments, *cells) - u64::from(*segments) * poles(side) as u64
                };
                profile.windows(2).map(side).sum()
            }
            Self::Teapot { cells } => 32 * square(*cells),
            Self::Triangles { triangles, .. } => triangles.len() as u64,
            Self::Mesh { .. } => return None,
        })
    }

    /// Reads or makes the triangles, of which there are to be so many copies; `painted` where
    /// something replaces a mesh's materials.
    pub(super) fn geometry(
        &self,
        table: &Table<'_>,
        origin: &Origin<'_>,
        painted: bool,
        copies: usize,
    ) -> Result<Geometry, SceneError> {
        if let Some(count) = self.triangle_count() {
            (origin.loading.triangles(count, copies))
                .map_err(|message| table.error("shape", message))?;
        }
        Ok(match self {
            Self::Quad => primitives::grid(1),
            Self::Grid { cells } => primitives::grid(*cells),
            Self::Cuboid { cells } => primitives::cuboid(*cells),
            Self::Sphere {
                center,
                radius,
                segments,
            } => primitives::sphere(*center, *radius, *segments),
            Self::Torus {
                radius,
                tube,
                segments,
            } => primitives::torus(*radius, *tube, *segments),
            Self::Lathe {
                profile,
                cells,
                segments,
                turn,
            } => primitives::lathe(profile, *cells, *segments, *turn),
            Self::Teapot { cells } => primitives::teapot(*cells),
            Self::Triangles {
                positions,
                triangles,
                colors,
            } => primitives::triangles(positions, triangles, colors),
            Self::Mesh { file, mtl } => {
                let path = find(table, "mesh", file, origin)?;
                let used_by = |error: SceneError| {
                    let (owner, file, line) = (table.owner(), table.file(), table.line("mesh"));
                    error.used_by(format_args!("the mesh of {owner}, {file}:{line}"))
                };
                if model::kind(&path) != Kind::Obj {
                    if mtl.is_some() {
                        return Err(table.error("mtl", "goes with an OBJ file alone"));
                    }
                    return model::surface(&path, painted, copies, &origin.loading)
                        .map_err(used_by);
                }
                let materials = match mtl {
                    _ if painted => Materials::Ignored,
                    None => Materials::Own,
                    Some(mtl) => {
                        let other = path.parent().unwrap_or(Path::new("")).join(mtl);
                        if !other.is_file() {
                            let message = format_args!("names no file: {}", other.display());
                            return Err(table.error("mtl", message));
                        }
                        Materials::Other(other)
                    }
                };
                obj::read(&path, &materials, copies, &origin.loading).map_err(used_by)?
            }
        })
    }
}

/// A file that a key names: beside the scene file, else in the models folder or its subfolder of that
/// name.
pub(super) fn find(
    table: &Table<'_>,
    key: &str,
    model: &str,
    origin: &Origin<'_>,
) -> Result<PathBuf, SceneError> {
    let stem = Path::new(model).file_stem().unwrap_or_default();
    let models = origin.options.models.as_ref();
    let candidates = origin.folder.iter().map(|folder| folder.join(model)).chain(
        models
            .iter()
            .flat_map(|folder| [folder.join(model), folder.join(stem).join(model)]),
    );
    if let Some(path) = candidates.into_iter().find(|path| path.is_file()) {
        return Ok(path);
    }
    let models = match models {
        Some(folder) => format!("in the models folder {}", folder.display()),
        None => "in a models folder: none is given".to_owned(),
    };
    Err(SceneError::MissingModel {
        file: table.file().to_owned(),
        line: table.line(key),
        owner: table.owner().to_owned(),
        model: model.to_owned(),
        searched: match origin.folder {
            Some(_) => format!("beside the scene file or {models}"),
            None => models,
        },
    })
}

/// `transform` and `repeat`: where each copy of the surface goes.
pub(super) fn copies(table: &Table<'_>) -> Result<Vec<Transform>, SceneError> {
    let mut all = vec![transform(table)?];
    for table in table.tables("repeat")? {
        let count = table.count("count", 1..=10_000)?;
        let degrees = table.vector("rotate_deg")?.unwrap_or(DVec3::ZERO);
        let about = table.vector("about")?.unwrap_or(DVec3::ZERO);
        let translate = table.vector("translate")?.unwrap_or(DVec3::ZERO);
        table.finish()?;
        let count = table.required("count", count)?;
        if all.len() * count as usize > MOST_COPIES {
            let message = format_args!("makes more than {MOST_COPIES} copies");
            return Err(table.error("count", message));
        }
        all = (0..count)
            .map(f64::from)
            .map(|k| Transform::rigid(k * degrees, about, k * translate))
            .flat_map(|step| all.iter().map(|copy| copy.then(&step)).collect::<Vec<_>>())
            .collect();
    }
    Ok(all)
}

/// `transform = { scale, rotate_deg, translate }`.
fn transform(table: &Table<'_>) -> Result<Transform, SceneError> {
    let Some(table) = table.table("transform")? else {
        return Ok(Transform::IDENTITY);
    };
    let scale = table.scale("scale")?.unwrap_or(DVec3::ONE);
    let degrees = table.vector("rotate_deg")?.unwrap_or(DVec3::ZERO);
    let translate = table.vector("translate")?.unwrap_or(DVec3::ZERO);
    table.finish()?;
    if scale.abs().min_element() < SMALLEST {
        return Err(table.error("scale", "must not be zero: the transform cannot be undone"));
    }
    Ok(Transform {
        linear: rotation(degrees) * DMat3::from_diagonal(scale),
        translate,
    })
}
