//! Fig. 4 and 5 of the paper: what a search follows, and where it has something to find.

use std::fmt::Write;

use catoptric_frame::{Image, VertexClass, write_png_rgb8, write_whole};
use catoptric_reference::true_vertices;
use catoptric_reflect::{CubemapStep, CubemapWalk};
use catoptric_scene::{LoadOptions, Scene, Shape};
use glam::{DVec3, Vec3};

use crate::output::PICTURES as FOLDER;
use crate::suites::suite::{Picture, Studio};

/// All pictures; none where the user asks for a scene of their own.
pub fn make(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    if studio.scene.is_some() {
        return Ok(Vec::new());
    }
    let regions = [
        ("prototype-sphere", "a closed mirror, a sphere"),
        (
            "prototype-bowl",
            "an open mirror, a bowl seen from its hollow side",
        ),
    ];
    let mut pictures = vec![field(studio)?];
    for (scene, what) in regions {
        pictures.push(region(studio, scene, what)?);
    }
    Ok(pictures)
}

/// Width and height of the drawing of the field.
const FIELD_PX: f32 = 560.0;
/// Arrows along an edge of the drawing.
const ARROWS: i32 = 25;
/// Coordinates on the face that the drawing spans, to either side.
const SPAN: f32 = 1.0;

/// Fig. 4: the field of projected bisectors on the face of the cube that looks at the eye, and the
/// steps of a search in it.
fn field(studio: &Studio<'_>) -> anyhow::Result<Picture> {
    let scene = Scene::load("prototype-ellipsoid", &LoadOptions::default())?;
    let spec = crate::run::load::parse("reflector-cubemap(start=eye,hidden=extend)")?;
    let walk = CubemapWalk::new(spec.options(), &scene, 0);
    let vertex = Vec3::new(1.3, 1.6, 1.2);
    let mut steps = Vec::new();
    walk.search(vertex, |step| steps.push(step));

    let path = format!("{FOLDER}/field.svg");
    let file = studio.draft.file(&path)?;
    let svg = draw_field(&walk, vertex, &steps)?;
    write_whole(&file, svg.as_bytes())?;
    Ok(Picture {
        figure: "iterations",
        path,
        size: [FIELD_PX as u32; 2],
        caption: format!(
            "The field that the search follows (Fig. 4): the projected bisector on the face +z of the \
             reflector cube map of the ellipsoid, for one vertex. Orange: {} steps from the point that \
             faces the eye (ring) to the reflection point (dot); small marks are the halfway points, where \
             the field is looked up a second time.",
            steps.len()
        ),
        alt: "Arrows on a square that all lead to one point, and a path along them".to_owned(),
    })
}

/// Place in the drawing of a place on the face +z.
fn on_drawing(place: Vec3) -> (f32, f32) {
    let at = |coordinate: f32| (coordinate / place.z / SPAN + 1.0) / 2.0 * FIELD_PX;
    (at(place.x), FIELD_PX - at(place.y))
}

fn draw_field(walk: &CubemapWalk, vertex: Vec3, steps: &[CubemapStep]) -> anyhow::Result<String> {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {FIELD_PX} {FIELD_PX}\" width=\"{FIELD_PX}\" \
         height=\"{FIELD_PX}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fdfdfb\"/>\n\
         <g stroke=\"#0072b2\" stroke-width=\"1.3\" fill=\"none\">\n"
    );
    let cell = FIELD_PX / ARROWS as f32;
    for row in 0..ARROWS {
        for column in 0..ARROWS {
            let coordinate = |index: i32| ((index as f32 + 0.5) / ARROWS as f32 * 2.0 - 1.0) * SPAN;
            let place = Vec3::new(coordinate(column), coordinate(row), 1.0);
            let bisector = walk.bisector(place, vertex);
            // Directions and, compressed, lengths: near the sink the field becomes small.
            let length = cell * 0.85 * (bisector.length() / 0.5).min(1.0).powf(0.4);
            let along = bisector.truncate().normalize_or_zero() * length;
            let (x, y) = on_drawing(place);
            let (dx, dy) = (along.x, -along.y);
            let (tip_x, tip_y) = (x + dx / 2.0, y + dy / 2.0);
            let barb = |turn: f32| {
                let (bx, by) = (0.3 * (dx + turn * dy), 0.3 * (dy - turn * dx));
                format!("M{:.1} {:.1}L{tip_x:.1} {tip_y:.1}", tip_x - bx, tip_y - by)
            };
            writeln!(
                svg,
                "<path d=\"M{:.1} {:.1}L{tip_x:.1} {tip_y:.1}{}{}\"/>",
                x - dx / 2.0,
                y - dy / 2.0,
                barb(0.6),
                barb(-0.6)
            )?;
        }
    }
    svg += "</g>\n<g stroke=\"#d55e00\" stroke-width=\"2.4\" fill=\"none\">\n";
    for step in steps {
        let (from, to) = (on_drawing(step.from), on_drawing(step.to));
        writeln!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\"/>",
            from.0, from.1, to.0, to.1
        )?;
    }
    if let (Some(first), Some(last)) = (steps.first(), steps.last()) {
        let (x, y) = on_drawing(first.from);
        writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\"/>")?;
        let (x, y) = on_drawing(last.to);
        writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\" fill=\"#d55e00\"/>"
        )?;
    }
    for step in steps {
        let (x, y) = on_drawing(step.halfway);
        writeln!(
            svg,
            "<path d=\"M{:.1} {y:.1}h6M{x:.1} {:.1}v6\"/>",
            x - 3.0,
            y - 3.0
        )?;
    }
    svg += "</g>\n</svg>\n";
    Ok(svg)
}

/// Pixels of the drawing of the regions.
const REGION_PX: [u32; 2] = [480, 360];
/// Half the height of what it shows, in radii of the mirror.
const REGION_SPAN: f64 = 3.2;

const REFLECTED: [u8; 3] = [122, 190, 120];
const HIDDEN: [u8; 3] = [120, 196, 216];
const UNREFLECTED: [u8; 3] = [222, 112, 92];
const UNKNOWN: [u8; 3] = [128, 128, 128];
const MIRROR: [u8; 3] = [40, 42, 48];
const EYE: [u8; 3] = [250, 200, 40];

/// Fig. 5: the regions of space around a mirror, in the plane of the eye and the mirror's centre
/// that is level for the camera, by the exact reflection points of the points of that plane.
fn region(studio: &Studio<'_>, name: &str, what: &str) -> anyhow::Result<Picture> {
    let mut scene = Scene::load(name, &LoadOptions::default())?;
    let shape = scene.mirrors[0].shape.clone();
    let (center, eye) = (shape.center(), scene.camera.eye);
    let (low, high) = shape.bounds();
    let radius = (high - low).max_element() / 2.0;
    let away = (eye - center).normalize();
    let side = scene.camera.up.cross(away).normalize();
    let [width, height] = REGION_PX;
    let scale = 2.0 * REGION_SPAN * radius / f64::from(height);
    // The eye is to the right.
    let place = |pixel: u32| {
        let x = f64::from(pixel % width) + 0.5 - f64::from(width) / 2.5;
        let y = f64::from(pixel / width) + 0.5 - f64::from(height) / 2.0;
        center + scale * (x * away + y * side)
    };
    let places: Vec<DVec3> = (0..width * height).map(place).collect();
    scene.objects.truncate(1);
    scene.objects[0].mesh.positions = places.iter().map(|place| place.as_vec3()).collect();
    let view = scene.camera.view([512, 512]);
    let vertices =
        true_vertices(&scene, &view).map_err(|reason| anyhow::anyhow!("{name}: {reason}"))?;
    let colors = vertices.iter().zip(&places).map(|(vertex, place)| {
        if place.distance(eye) < 6.0 * scale {
            EYE
        } else if is_mirror(&shape, *place, 1.5 * scale) {
            MIRROR
        } else {
            match vertex.class {
                VertexClass::Reflected => REFLECTED,
                VertexClass::Hidden => HIDDEN,
                VertexClass::Unreflected => UNREFLECTED,
                VertexClass::Unknown => UNKNOWN,
            }
        }
    });
    let image = Image::from_vec(REGION_PX, colors.collect());
    let path = format!("{FOLDER}/regions.{name}.png");
    let file = studio.draft.file(&path)?;
    write_png_rgb8(&image, &file)?;
    Ok(Picture {
        figure: "silhouette",
        path,
        size: REGION_PX,
        caption: format!(
            "Regions around {what} (Fig. 5), seen from above, the eye (yellow) to the right: reflected \
             (green), hidden (blue), and with open mirrors neither (red). By exact reflection points."
        ),
        alt: format!("Map of the plane through the eye and {what}, coloured by region"),
    })
}

/// Whether a place belongs to the drawing of the mirror, whose line is so wide: to the inside of a
/// closed one, to the line of an open one.
fn is_mirror(shape: &Shape, place: DVec3, line: f64) -> bool {
    if shape.is_closed() {
        return shape.encloses(place);
    }
    let across = shape.normal_at(place).unwrap_or(DVec3::Y);
    let hit = shape.intersect(place - line * across, across, 0.0);
    hit.is_some_and(|hit| hit.t < 2.0 * line)
}
