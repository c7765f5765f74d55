//! BSDFs and textures as a colour, and whether they make a mirror.

use std::path::Path;

use catoptric_frame::Channels;
use catoptric_scene::model::{PictureSource, Triangles};
use glam::{DMat4, DVec3, Vec2, Vec3};
use roxmltree::Node;

use super::nodes::{File, child, children, name_of};
use super::reader::{DEEPEST, GRAY, Reader, turn_v};
use crate::import::colors;
use crate::import::found::Coat;

/// What a shape is made of.
#[derive(Default)]
pub struct Material {
    pub name: String,
    /// Its colour, where it is said.
    pub coat: Option<Laid>,
    pub is_mirror: bool,
    /// It gives light: its colour is that of the light.
    pub shines: bool,
    /// Both sides are made of it.
    pub two_sided: bool,
}

/// A colour and how texture coordinates are changed for it.
#[derive(Clone)]
pub struct Laid {
    coat: Coat,
    to_uv: DMat4,
}

impl Laid {
    /// Why it is not laid on this mesh: what the mesh has nothing of.
    pub fn lacks(&self, mesh: &Triangles) -> Option<&'static str> {
        match self.coat {
            Coat::Color(_) => None,
            Coat::Vertex if mesh.colors.is_empty() => Some("colours"),
            Coat::Vertex => None,
            _ if mesh.uvs.is_empty() => Some("texture coordinates"),
            _ => None,
        }
    }

    /// Whether it is one colour everywhere.
    pub fn is_plain(&self) -> bool {
        matches!(self.coat, Coat::Color(_))
    }

    /// Moves the texture coordinates of a mesh as this wants them.
    pub fn lay(self, mesh: &mut Triangles) -> Coat {
        if self.lacks(mesh).is_some() {
            return self.color();
        }
        if self.to_uv != DMat4::IDENTITY {
            for uv in mesh.uvs.as_flattened_mut() {
                let moved =
                    self.to_uv
                        .transform_point3(DVec3::new(f64::from(uv.x), f64::from(uv.y), 0.0));
                *uv = Vec2::new(moved.x as f32, moved.y as f32);
            }
        }
        if matches!(self.coat, Coat::Picture { .. } | Coat::Texels { .. }) {
            // Mitsuba's pictures begin at the top, ours at the bottom.
            turn_v(mesh);
        }
        self.coat
    }

    /// One colour in its place.
    pub fn color(&self) -> Coat {
        Coat::Color(mean(&self.coat))
    }
}

/// One colour for what has several.
fn mean(coat: &Coat) -> Vec3 {
    match coat {
        Coat::Color(color) | Coat::Picture { tint: color, .. } => *color,
        Coat::Vertex => GRAY,
        Coat::Checker { a, b, .. } => (*a + *b) / 2.0,
        Coat::Texels { texels, .. } => {
            texels.iter().copied().sum::<Vec3>() / texels.len().max(1) as f32
        }
    }
}

/// A BSDF, or one inside it.
pub fn read<'f>(
    reader: &mut Reader<'_>,
    file: File<'f>,
    node: Node<'f, 'f>,
    depth: usize,
) -> anyhow::Result<Material> {
    if depth > DEEPEST {
        return Err(file.error(node, "materials are in each other without end"));
    }
    let name = name_of(node).unwrap_or_default().to_owned();
    let mut made = Material {
        name,
        ..Material::default()
    };
    let kind = node.attribute("type").unwrap_or_default();
    let color = |reader: &mut Reader<'_>, name: &str| -> anyhow::Result<Option<Laid>> {
        match child(node, name) {
            Some(child) => coat(reader, file, child, depth + 1),
            None => Ok(None),
        }
    };
    match kind {
        "diffuse" | "roughdiffuse" => made.coat = color(reader, "reflectance")?,
        "plastic" | "roughplastic" => made.coat = color(reader, "diffuse_reflectance")?,
        "principled" | "principledthin" => {
            made.coat = color(reader, "base_color")?;
            let metal = reader.untextured(file, node, "metallic")?.unwrap_or(0.0);
            let roughness = reader.untextured(file, node, "roughness")?.unwrap_or(0.5);
            made.is_mirror = metal >= 0.5 && roughness <= reader.choice.roughness;
        }
        "conductor" | "dielectric" | "thindielectric" => made.is_mirror = true,
        "roughconductor" | "roughdielectric" => {
            let alpha = reader.untextured(file, node, "alpha")?.unwrap_or(0.1);
            made.is_mirror = alpha <= reader.choice.roughness;
            made.coat = color(reader, "specular_reflectance")?;
        }
        // Around another one.
        _ => {
            let inner = children(node).find_map(|child| {
                let found = file.resolved(child)?;
                found.1.has_tag_name("bsdf").then_some(found)
            });
            match inner {
                Some((of, inner)) => {
                    let inside = read(reader, of, inner, depth + 1)?;
                    made.coat = inside.coat;
                    made.is_mirror = inside.is_mirror;
                    made.two_sided = inside.two_sided || kind == "twosided";
                    if !["twosided", "mask"].contains(&kind) {
                        reader.leave_out(file, node, ": what it adds to the material inside");
                    }
                }
                None => reader.leave_out(file, node, ": there is no such material here"),
            }
        }
    }
    Ok(made)
}

/// A colour, a texture or a reference to one.
pub fn coat<'f>(
    reader: &mut Reader<'_>,
    file: File<'f>,
    node: Node<'f, 'f>,
    depth: usize,
) -> anyhow::Result<Option<Laid>> {
    if depth > DEEPEST {
        return Err(file.error(node, "textures are in each other without end"));
    }
    let plain = |coat: Coat| Laid {
        coat,
        to_uv: DMat4::IDENTITY,
    };
    match node.tag_name().name() {
        "ref" => match file.resolved(node) {
            Some((of, found)) => coat(reader, of, found, depth + 1),
            None => Err(file.error(node, "nothing has this id")),
        },
        "rgb" | "srgb" | "spectrum" | "float" => {
            let color = reader.color(file, node)?;
            if color.is_none() {
                reader.leave_out(file, node, ": a spectrum");
            }
            Ok(color.map(|color| plain(Coat::Color(colors::usable(color)))))
        }
        "texture" => texture(reader, file, node, depth),
        _ => Ok(None),
    }
}

fn texture<'f>(
    reader: &mut Reader<'_>,
    file: File<'f>,
    node: Node<'f, 'f>,
    depth: usize,
) -> anyhow::Result<Option<Laid>> {
    let to_uv = reader.transform(file, node, "to_uv")?;
    match node.attribute("type").unwrap_or_default() {
        "bitmap" => {
            let path = reader.picture(file, node)?;
            let nearest = reader.text(file, node, "filter_type")?.as_deref() == Some("nearest");
            let coat = match is_exr(&path) {
                true => texels(&path)?,
                false => Some(Coat::Picture {
                    tint: Vec3::ONE,
                    source: PictureSource::File(path.clone()),
                }),
            };
            let Some(coat) = coat else {
                reader.leave_out(file, node, ": it has no colours");
                return Ok(None);
            };
            if !is_exr(&path) && reader.flag(file, node, "raw")? {
                reader.leave_out(file, node, ": `raw`; its values are taken for sRGB");
            }
            if nearest {
                let checked = checker(&coat, &to_uv);
                if checked.is_none() {
                    reader.leave_out(file, node, ": `nearest`; it is filtered bilinearly");
                }
                if let Some(coat) = checked {
                    return Ok(Some(Laid {
                        coat,
                        to_uv: DMat4::IDENTITY,
                    }));
                }
            }
            Ok(Some(Laid { coat, to_uv }))
        }
        "checkerboard" => {
            let mut pair = [Vec3::splat(0.4), Vec3::splat(0.2)];
            for (place, name) in ["color0", "color1"].into_iter().enumerate() {
                if let Some(child) = child(node, name)
                    && let Some(laid) = coat(reader, file, child, depth + 1)?
                {
                    pair[place] = mean(&laid.coat);
                }
            }
            let [a, b] = pair;
            Ok(Some(match cells(&to_uv) {
                Some(cells) => Laid {
                    coat: Coat::Checker { a, b, cells },
                    to_uv: DMat4::IDENTITY,
                },
                None => {
                    reader.leave_out(file, node, ": its cells; it has their mean colour");
                    Laid {
                        coat: Coat::Color((a + b) / 2.0),
                        to_uv: DMat4::IDENTITY,
                    }
                }
            }))
        }
        "mesh_attribute" => Ok(Some(Laid {
            coat: Coat::Vertex,
            to_uv: DMat4::IDENTITY,
        })),
        _ => {
            reader.leave_out(file, node, ": there is no such texture here");
            Ok(None)
        }
    }
}

fn is_exr(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    ending.eq_ignore_ascii_case("exr")
}

/// Most texels of a picture in a file of floats.
const MOST_TEXELS: u64 = 1 << 26;

/// The colours of an EXR.
fn texels(path: &Path) -> anyhow::Result<Option<Coat>> {
    let channels = Channels::read(path)?;
    let [width, height] = channels.size();
    if u64::from(width) * u64::from(height) > MOST_TEXELS {
        return Ok(None);
    }
    let colors = channels.colors("")?;
    Ok(colors.map(|colors| Coat::Texels {
        size: colors.size(),
        texels: colors
            .pixels()
            .iter()
            .map(|color| colors::usable(*color))
            .collect(),
    }))
}

/// Cells of a checkerboard along u and v in [0, 1], where a whole number of them is as wide as high.
fn cells(to_uv: &DMat4) -> Option<u32> {
    let (u, v) = (to_uv.x_axis.x, to_uv.y_axis.y);
    let is_scale = *to_uv == DMat4::from_scale(DVec3::new(u, v, to_uv.z_axis.z));
    let cells = 2.0 * u;
    let whole = cells == cells.round() && (1.0..=65536.0).contains(&cells);
    (is_scale && u == v && whole).then_some(cells as u32)
}

/// A picture of 2 by 2 texels, two of each colour, as the checkerboard that it is.
fn checker(coat: &Coat, to_uv: &DMat4) -> Option<Coat> {
    let Coat::Texels {
        size: [2, 2],
        texels,
    } = coat
    else {
        return None;
    };
    let [a, b, c, d] = texels[..] else {
        return None;
    };
    (a == d && b == c).then_some(())?;
    Some(Coat::Checker {
        a,
        b,
        cells: cells(to_uv)?,
    })
}
