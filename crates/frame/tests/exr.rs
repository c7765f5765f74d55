//! Frames to files and back, files from elsewhere, and files that are wrong.

use std::path::Path;

use catoptric_frame::{
    Channels, Frame, FrameError, Image, Motion, Name, Primary, Reflected, Status,
};
use exr::prelude::*;
use glam::{Vec2, Vec3};

const SIZE: [u32; 2] = [5, 3];

/// Fifteen pixels, every one different from the others.
fn numbered<T>(pixel: impl Fn(u32) -> T) -> Image<T> {
    Image::from_vec(SIZE, (0..15).map(pixel).collect())
}

fn vectors(scale: f32) -> Image<Vec3> {
    numbered(|i| Vec3::new(0.1, 1.0 / 3.0, -2.7) * (i as f32 * scale))
}

fn names() -> Vec<Name> {
    vec![
        Name {
            id: 1,
            name: "large floor".into(),
            mirror: false,
        },
        Name {
            id: 2,
            name: "Kugel ä".into(),
            mirror: true,
        },
    ]
}

fn full_frame() -> Frame {
    use Status::*;
    let status = [NotMirror, Resolved, Unresolved, Below, Back];
    Frame {
        color: vectors(1.0),
        primary: Some(Primary {
            id: numbered(|i| u32::from(i % 5 > 0) * 2),
            position: vectors(2.0),
            normal: vectors(3.0),
        }),
        reflected: Some(Reflected {
            status: numbered(|i| status[i as usize % 5]),
            id: numbered(|i| u32::from(i % 5 == 1) * 16_777_215),
            position: vectors(4.0),
            distance: numbered(|i| i as f32 / 7.0),
            bounces: Some(numbered(|i| i)),
        }),
        motion: Some(Motion {
            vector: numbered(|i| Vec2::new(i as f32 / 3.0, -2.0) * (i % 2) as f32),
            valid: numbered(|i| i % 2 == 1),
            disoccluded: Some(numbered(|i| i % 4 == 1)),
            converted: None,
        }),
        names: names(),
    }
}

/// Runs `check` with a path for a file, in a folder that is removed afterwards.
fn with_path(check: impl FnOnce(&Path)) {
    let folder = tempfile::tempdir().unwrap();
    check(&folder.path().join("frame.exr"));
}

fn round_trip(frame: &Frame) {
    with_path(|path| {
        frame.write_exr(path).unwrap();
        assert_eq!(&Frame::read_exr(path).unwrap(), frame);
    });
}

#[test]
fn all_layers_come_back_bit_for_bit() {
    round_trip(&full_frame());
}

#[test]
fn layers_that_are_not_there_stay_away() {
    let mut frame = full_frame();
    frame.reflected.as_mut().unwrap().bounces = None;
    round_trip(&frame);
    frame.names.clear();
    round_trip(&frame);
    frame.reflected = None;
    round_trip(&frame);
    frame.primary = None;
    round_trip(&frame);
}

#[test]
fn infinities_survive() {
    let mut frame = full_frame();
    *frame.color.at_mut(2, 1) = Vec3::new(f32::INFINITY, f32::MIN_POSITIVE, -0.0);
    round_trip(&frame);
}

#[test]
fn the_file_is_what_other_programs_expect() {
    with_path(|path| {
        full_frame().write_exr(path).unwrap();
        let meta = MetaData::read_from_file(path, true).unwrap();
        assert_eq!(meta.headers.len(), 1);
        let header = &meta.headers[0];
        let channels: Vec<String> = header
            .channels
            .list
            .iter()
            .map(|channel| channel.name.to_string())
            .collect();
        let expected = [
            "B",
            "G",
            "R",
            "bounces",
            "motion.X",
            "motion.Y",
            "motion.disoccluded",
            "motion.valid",
            "primary.id",
            "primary.normal.X",
            "primary.normal.Y",
            "primary.normal.Z",
            "primary.position.X",
            "primary.position.Y",
            "primary.position.Z",
            "reflected.distance",
            "reflected.id",
            "reflected.position.X",
            "reflected.position.Y",
            "reflected.position.Z",
            "reflected.status",
        ];
        assert_eq!(channels, expected);
        assert!(
            header
                .channels
                .list
                .iter()
                .all(|c| c.sample_type == SampleType::F32)
        );
        assert_eq!(header.compression, Compression::ZIP16);
        assert_eq!(header.blocks, exr::meta::BlockDescription::ScanLines);
        assert_eq!(header.layer_size, Vec2(5, 3));
        assert_eq!(header.own_attributes.layer_position, Vec2(0, 0));
        assert_eq!(header.shared_attributes.display_window.size, Vec2(5, 3));
        let ids = &header.own_attributes.other[&Text::from("catoptric.ids")];
        let text = std::str::from_utf8(ids.to_text().unwrap().as_slice()).unwrap();
        assert_eq!(text, "1 object large floor\n2 mirror Kugel ä\n");
    });
}

#[test]
fn row_zero_is_on_top() {
    let mut frame = Frame {
        color: Image::filled(SIZE, Vec3::ZERO),
        primary: None,
        reflected: None,
        motion: None,
        names: Vec::new(),
    };
    *frame.color.at_mut(4, 0) = Vec3::ONE;
    with_path(|path| {
        frame.write_exr(path).unwrap();
        let image = read_first_rgba_layer_from_file(
            path,
            |size, _| vec![vec![0.0; size.width()]; size.height()],
            |rows, at, (r, _, _, _): (f32, f32, f32, f32)| rows[at.y()][at.x()] = r,
        );
        assert_eq!(image.unwrap().layer_data.channel_data.pixels[0][4], 1.0);
    });
}

/// A file as another program might write it.
fn write_foreign(path: &Path, channels: Vec<(&str, FlatSamples)>, attributes: LayerAttributes) {
    let list = channels
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, samples));
    let layer = Layer::new(
        (2, 1),
        attributes,
        Encoding::SMALL_FAST_LOSSLESS,
        AnyChannels::sort(list.collect()),
    );
    exr::image::Image::from_layer(layer)
        .write()
        .to_file(path)
        .unwrap();
}

fn floats(samples: [f32; 2]) -> FlatSamples {
    FlatSamples::F32(samples.to_vec())
}

fn rgb() -> Vec<(&'static str, FlatSamples)> {
    let half = [0.5, 0.25].map(f16::from_f32).to_vec();
    vec![
        ("R", FlatSamples::F16(half)),
        ("G", floats([1.0, 2.0])),
        ("B", FlatSamples::U32(vec![3, 4])),
        ("A", floats([1.0, 1.0])),
    ]
}

fn with_layers() -> Vec<(&'static str, FlatSamples)> {
    let mut channels = rgb();
    for name in ["position.X", "position.Y", "position.Z"] {
        channels.push((["primary.", name].concat().leak(), floats([1.0, 2.0])));
        channels.push((["reflected.", name].concat().leak(), floats([3.0, 4.0])));
    }
    for name in ["primary.normal.X", "primary.normal.Y", "primary.normal.Z"] {
        channels.push((name, floats([0.0, 1.0])));
    }
    channels.push(("primary.id", FlatSamples::U32(vec![1, 2])));
    channels.push(("reflected.id", FlatSamples::U32(vec![0, 1])));
    channels.push(("reflected.distance", floats([0.0, 5.0])));
    channels
}

#[test]
fn colour_alone_in_mixed_sample_types_is_enough() {
    with_path(|path| {
        write_foreign(path, rgb(), LayerAttributes::default());
        let frame = Frame::read_exr(path).unwrap();
        assert_eq!(
            frame.color.pixels(),
            [Vec3::new(0.5, 1.0, 3.0), Vec3::new(0.25, 2.0, 4.0)]
        );
        assert!(frame.primary.is_none() && frame.reflected.is_none() && frame.names.is_empty());
    });
}

#[test]
fn a_missing_status_follows_from_the_names() {
    with_path(|path| {
        write_foreign(path, with_layers(), LayerAttributes::default());
        let mut frame = Frame::read_exr(path).unwrap();
        let status = |frame: &Frame| frame.reflected.as_ref().unwrap().status.pixels().to_vec();
        frame.assign_names(names());
        assert_eq!(status(&frame), [Status::NotMirror, Status::Resolved]);
        assert_eq!(frame.names, names());

        frame.reflected.as_mut().unwrap().status.pixels_mut()[1] = Status::Unresolved;
        frame.assign_names(names());
        assert_eq!(
            status(&frame),
            [Status::NotMirror, Status::Unresolved],
            "kept"
        );
    });
    with_path(|path| {
        let mut attributes = LayerAttributes::default();
        let list = Text::from("2 mirror ball\n1 object floor");
        attributes
            .other
            .insert(Text::from("catoptric.ids"), AttributeValue::Text(list));
        write_foreign(path, with_layers(), attributes);
        let frame = Frame::read_exr(path).unwrap();
        assert_eq!(frame.names[0].name, "floor");
        assert_eq!(
            frame.reflected.unwrap().status.pixels()[1],
            Status::Resolved
        );
    });
}

#[test]
fn a_missing_status_without_names_follows_from_the_ids() {
    // Three surfaces: 3 reflects 1 somewhere and nothing elsewhere, 1 and 2 reflect nothing.
    let id = |x: u32| [1, 2, 3, 3, 3][x as usize];
    let mut frame = full_frame();
    frame.names.clear();
    frame.primary.as_mut().unwrap().id = numbered(|i| id(i % 5));
    let reflected = frame.reflected.as_mut().unwrap();
    reflected.id = numbered(|i| u32::from(i == 2));
    with_path(|path| {
        frame.write_exr(path).unwrap();
        let image = read_all_flat_layers_from_file(path).unwrap();
        let mut layer = image.layer_data.into_iter().next().unwrap();
        let list = &mut layer.channel_data.list;
        list.retain(|channel| !channel.name.eq("reflected.status"));
        exr::image::Image::from_layer(layer)
            .write()
            .to_file(path)
            .unwrap();

        let channels = Channels::read(path).unwrap();
        let note = channels.status_note().unwrap();
        assert!(
            note.contains("frame.exr") && note.contains("reflected.status"),
            "{note}"
        );
        let read = Frame::from_channels(&channels).unwrap();
        let expected = numbered(|i| match id(i % 5) {
            3 => Status::Resolved,
            _ => Status::NotMirror,
        });
        assert_eq!(read.reflected.unwrap().status, expected);
    });
    with_path(|path| {
        full_frame().write_exr(path).unwrap();
        assert_eq!(Channels::read(path).unwrap().status_note(), None);
    });
}

/// What reading these channels complains about.
fn complaint(channels: Vec<(&str, FlatSamples)>, attributes: LayerAttributes) -> String {
    let mut text = String::new();
    with_path(|path| {
        write_foreign(path, channels, attributes);
        text = Frame::read_exr(path).unwrap_err().to_string();
    });
    assert!(text.contains("frame.exr"), "names the file: {text}");
    text
}

#[test]
fn a_missing_channel_is_named() {
    let none = LayerAttributes::default;
    let mut channels = rgb();
    channels.remove(1);
    let text = complaint(channels, none());
    assert!(
        text.contains("`G` is missing") && text.contains("A B R"),
        "{text}"
    );

    let mut channels = with_layers();
    channels.retain(|(name, _)| *name != "reflected.position.Y");
    assert!(complaint(channels, none()).contains("`reflected.position.Y` is missing"));

    let mut channels = with_layers();
    channels.retain(|(name, _)| *name != "primary.id");
    assert!(complaint(channels, none()).contains("`primary.id` is missing"));
}

#[test]
fn odd_values_are_named_with_their_place() {
    for (odd, shown) in [(0.5, "0.5"), (-1.0, "-1"), (f32::NAN, "NaN")] {
        let mut channels = with_layers();
        channels.retain(|(name, _)| *name != "reflected.id");
        channels.push(("reflected.id", floats([0.0, odd])));
        let text = complaint(channels, LayerAttributes::default());
        assert!(
            text.contains("`reflected.id`") && text.contains("column 1, row 0"),
            "{text}"
        );
        assert!(text.contains(shown), "{text}");
    }
    let mut channels = with_layers();
    channels.push(("reflected.status", floats([0.0, 9.0])));
    assert!(complaint(channels, LayerAttributes::default()).contains("status code"));
}

#[test]
fn odd_headers_are_refused() {
    let mut attributes = LayerAttributes::default();
    let list = AttributeValue::Text(Text::from("floor"));
    attributes.other.insert(Text::from("catoptric.ids"), list);
    assert!(complaint(with_layers(), attributes).contains("catoptric.ids"));

    let attributes = LayerAttributes {
        layer_position: Vec2(1, 0),
        ..LayerAttributes::default()
    };
    with_path(|path| {
        let list = rgb()
            .into_iter()
            .map(|(name, samples)| AnyChannel::new(name, samples));
        let channels = AnyChannels::sort(list.collect());
        let layer = Layer::new((2, 1), attributes, Encoding::UNCOMPRESSED, channels);
        let display = ImageAttributes::new(IntegerBounds::from_dimensions((4, 1)));
        exr::image::Image::empty(display)
            .with_layer(layer)
            .write()
            .to_file(path)
            .unwrap();
        let text = Frame::read_exr(path).unwrap_err().to_string();
        assert!(text.contains("data window"), "{text}");
    });
}

#[test]
fn files_that_are_none() {
    let complaint = |path: &Path| Frame::read_exr(path).unwrap_err().to_string();
    with_path(|path| {
        assert!(
            matches!(Frame::read_exr(path), Err(FrameError::Read { .. })),
            "not there"
        );
        std::fs::write(path, "a text").unwrap();
        assert!(
            matches!(Frame::read_exr(path), Err(FrameError::Exr { .. })),
            "not EXR"
        );
        std::fs::write(path, "").unwrap();
        assert!(complaint(path).contains("is empty"), "{}", complaint(path));
        let folder = complaint(path.parent().unwrap());
        assert!(folder.contains("is a folder"), "{folder}");
    });
}

#[test]
fn a_file_that_was_cut_off_anywhere_is_refused_in_words() {
    with_path(|path| {
        full_frame().write_exr(path).unwrap();
        let bytes = std::fs::read(path).unwrap();
        for length in 1..bytes.len() {
            std::fs::write(path, &bytes[..length]).unwrap();
            let error = Frame::read_exr(path).unwrap_err().to_string();
            assert!(
                error.contains("cut off"),
                "{length} of {}: {error}",
                bytes.len()
            );
        }
    });
}

/// A small file whose windows, data and display, are another size: what was there is replaced.
fn with_window(path: &Path, [left, top, right, bottom]: [i32; 4]) {
    let mut frame = full_frame();
    (frame.primary, frame.reflected) = (None, None);
    frame.write_exr(path).unwrap();
    let mut bytes = std::fs::read(path).unwrap();
    for name in ["dataWindow", "displayWindow"] {
        let attribute = [name.as_bytes(), b"\0box2i\0\x10\0\0\0"].concat();
        let mut windows = bytes.windows(attribute.len());
        let at = windows.position(|window| window == attribute).unwrap() + attribute.len();
        let window = [left, top, right, bottom].map(i32::to_le_bytes).concat();
        bytes[at..at + 16].copy_from_slice(&window);
    }
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn windows_are_checked_before_anything_is_decoded() {
    for (window, said) in [
        (
            [0, 0, 999_999_999, 15],
            "1000000000 × 16 pixels; 33554432 in all",
        ),
        ([0, 0, 7, 999_999_999], "8 × 1000000000 pixels"),
        ([-553_648_128, 0, 8, 6], "553648137 × 7 pixels"),
        ([0, 0, 999_999_999, 999_999_999], "33554432 in all"),
        ([0, 0, 5791, 5791], "cannot be in"),
    ] {
        with_path(|path| {
            with_window(path, window);
            let error = Frame::read_exr(path).unwrap_err().to_string();
            assert!(error.contains(said), "{window:?}: {error}");
        });
    }
}

#[test]
fn parts_deep_data_and_channels_without_number_are_refused() {
    let refused =
        |channels: Vec<(&str, FlatSamples)>| complaint(channels, LayerAttributes::default());
    let many = (0..65).map(|index| (&*format!("c{index:02}").leak(), floats([0.0; 2])));
    let error = refused(many.collect());
    assert!(error.contains("65 channels; 64"), "{error}");

    with_path(|path| {
        let part = |name: &str| {
            let list = rgb()
                .into_iter()
                .map(|(name, samples)| AnyChannel::new(name, samples));
            let channels = AnyChannels::sort(list.collect());
            let attributes = LayerAttributes::named(name);
            Layer::new((2, 1), attributes, Encoding::UNCOMPRESSED, channels)
        };
        let display = ImageAttributes::new(IntegerBounds::from_dimensions((2, 1)));
        exr::image::Image::empty(display)
            .with_layer(part("a"))
            .with_layer(part("b"))
            .write()
            .to_file(path)
            .unwrap();
        let error = Frame::read_exr(path).unwrap_err().to_string();
        assert!(error.contains("2 parts"), "{error}");
    });
}

#[test]
fn no_changed_byte_of_a_header_brings_the_program_down() {
    with_path(|path| {
        let mut frame = full_frame();
        (frame.primary, frame.reflected) = (None, None);
        frame.write_exr(path).unwrap();
        let bytes = std::fs::read(path).unwrap();
        for at in 0..bytes.len() {
            for changed in [0, 0x7f, 0xff] {
                let mut bytes = bytes.clone();
                bytes[at] = changed;
                std::fs::write(path, bytes).unwrap();
                // Whatever comes of it; what counts is that it comes, soon and in little memory.
                let _ = Frame::read_exr(path);
            }
        }
    });
}

#[test]
fn what_cannot_be_written_leaves_nothing_behind() {
    with_path(|path| {
        full_frame().write_exr(path).unwrap();
        let before = std::fs::read(path).unwrap();

        let mut frame = full_frame();
        frame.primary.as_mut().unwrap().normal = Image::filled([1, 1], Vec3::ZERO);
        let text = frame.write_exr(path).unwrap_err().to_string();
        assert!(text.contains("primary.normal"), "{text}");

        let mut frame = full_frame();
        frame.names[0].name = "two\nlines".into();
        assert!(
            frame
                .write_exr(path)
                .unwrap_err()
                .to_string()
                .contains("line break")
        );

        let mut frame = full_frame();
        *frame.primary.as_mut().unwrap().id.at_mut(0, 0) = u32::MAX;
        assert!(
            frame
                .write_exr(path)
                .unwrap_err()
                .to_string()
                .contains("primary.id")
        );

        assert_eq!(std::fs::read(path).unwrap(), before);
        assert_eq!(
            std::fs::read_dir(path.parent().unwrap()).unwrap().count(),
            1
        );
        let nowhere = path.join("frame.exr");
        assert!(matches!(
            full_frame().write_exr(nowhere),
            Err(FrameError::Write { .. })
        ));
    });
}
