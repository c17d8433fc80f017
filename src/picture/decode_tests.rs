//! Every format, whole and cut off, and pictures that are too large.

use image::{ColorType, ExtendedColorType, ImageEncoder};

use super::*;

/// A picture of four by three pixels with colours of its own.
fn sample() -> DynamicImage {
    let pixel = |x: u32, y: u32| image::Rgba([(60 * x) as u8, (100 * y) as u8, 200, 255]);
    DynamicImage::ImageRgba8(image::RgbaImage::from_fn(4, 3, pixel))
}

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

const FORMATS: [ImageFormat; 10] = [
    ImageFormat::Png,
    ImageFormat::Jpeg,
    ImageFormat::Gif,
    ImageFormat::Bmp,
    ImageFormat::WebP,
    ImageFormat::Tiff,
    ImageFormat::Pnm,
    ImageFormat::Tga,
    ImageFormat::Ico,
    ImageFormat::Qoi,
];

#[test]
fn every_format_is_told_by_its_content() {
    for format in FORMATS {
        let image = if format == ImageFormat::Jpeg { DynamicImage::ImageRgb8(sample().to_rgb8()) } else { sample() };
        let picture = decode(&encoded(&image, format)).unwrap();
        assert_eq!((picture.width, picture.height, picture.rgba.len()), (4, 3, 48), "{format:?}");
        if format != ImageFormat::Jpeg {
            assert_eq!(picture.rgba, sample().to_rgba8().into_raw(), "{format:?}");
        }
    }
}

#[test]
fn every_depth_becomes_eight_bits_of_four_channels() {
    let image = sample();
    let grey = image.to_luma8();
    for other in [
        DynamicImage::ImageRgba16(image.to_rgba16()),
        DynamicImage::ImageRgb16(image.to_rgb16()),
        DynamicImage::ImageRgb8(image.to_rgb8()),
    ] {
        assert_eq!(decode(&encoded(&other, ImageFormat::Png)).unwrap().rgba, image.to_rgba8().into_raw());
    }
    let want: Vec<u8> = grey.as_raw().iter().flat_map(|&l| [l, l, l, 255]).collect();
    for other in [
        DynamicImage::ImageLuma8(grey.clone()),
        DynamicImage::ImageLumaA8(image.to_luma_alpha8()),
        DynamicImage::ImageLuma16(DynamicImage::ImageLuma8(grey.clone()).to_luma16()),
    ] {
        assert_eq!(decode(&encoded(&other, ImageFormat::Png)).unwrap().rgba, want);
    }
}

#[test]
fn sixteen_bits_are_rounded_to_the_nearest_of_eight() {
    let values: Vec<u16> = (0..=u16::MAX).collect();
    let all = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(256, 256, values).unwrap();
    let rgba = decode(&encoded(&DynamicImage::ImageLuma16(all), ImageFormat::Png)).unwrap().rgba;
    for (value, pixel) in rgba.as_chunks::<4>().0.iter().enumerate() {
        let nearest = (value as f64 / 257.0).round() as u8;
        assert_eq!(*pixel, [nearest, nearest, nearest, 255], "{value}");
    }
}

#[test]
fn cut_off_and_damaged_files_are_errors_of_one_line() {
    for format in FORMATS {
        let image = if format == ImageFormat::Jpeg { DynamicImage::ImageRgb8(sample().to_rgb8()) } else { sample() };
        let whole = encoded(&image, format);
        for length in 0..whole.len() {
            // Some formats end with what is not needed, and then the picture is whole.
            if let Err(error) = decode(&whole[..length]) {
                assert!(!error.to_string().contains('\n'), "{error}");
            }
            let mut wrong = whole.clone();
            wrong[length] ^= 0x5A;
            if let Err(error) = decode(&wrong) {
                assert!(!error.to_string().contains('\n'), "{error}");
            }
        }
        assert!(decode(&whole[..whole.len() / 2]).is_err(), "{format:?}");
    }
}

#[test]
fn what_is_no_picture_is_told() {
    for bytes in [&b""[..], b"hello, this is no picture at all", &[0; 100], b"<?xml version='1.0'?><html/>"] {
        assert_eq!(decode(bytes), Err(PictureError::Unknown));
    }
    for bytes in [&b"<svg></svg>"[..], b"\xEF\xBB\xBF <?xml version='1.0'?>\n<!-- by hand -->\n<svg/>"] {
        assert_eq!(decode(bytes), Err(PictureError::Drawing));
    }
}

#[test]
fn large_pictures_are_refused_by_their_header() {
    let header = |width: u32, height: u32| {
        let mut bytes = b"P5\n".to_vec();
        bytes.extend(format!("{width} {height}\n255\n").bytes());
        bytes
    };
    let error = decode(&header(16_385, 10)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the picture is 16385 x 10 pixels: 16384 a side and 64 million in all are the most; scale it down"
    );
    assert!(matches!(decode(&header(16_000, 16_000)), Err(PictureError::TooLarge { .. })));
    assert!(matches!(decode(&header(8_000, 8_000)), Err(PictureError::Damaged { .. })));
    assert!(matches!(check_size((0, 7), 0, false), Err(PictureError::NoPixels { .. })));
    // 8192^2 pixels of four times 16 bits are 512 MiB, and 256 MiB more as RGBA.
    assert_eq!(check_size((8192, 8192), 8 << 26, false), Err(PictureError::TooHeavy { needed: 768, limit: 480 }));
    assert_eq!(check_size((8192, 8192), 4 << 26, true), Ok(()));
    // Grey and alpha of 16 bits have four bytes a pixel too, and are not taken over.
    assert!(check_size((8192, 8192), 4 << 26, false).is_err());
}

#[test]
fn the_first_frame_of_an_animation_is_taken() {
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::gif::GifEncoder::new(&mut bytes);
    let frame =
        |value: u8| image::Frame::new(image::RgbaImage::from_pixel(5, 5, image::Rgba([value, value, value, 255])));
    encoder.encode_frames([frame(10), frame(200)]).unwrap();
    drop(encoder);
    assert_eq!(decode(&bytes).unwrap().rgba[..4], [10, 10, 10, 255]);
}

#[test]
fn a_palette_and_bits_are_spread() {
    let mut bytes = Vec::new();
    let encoder = image::codecs::bmp::BmpEncoder::new(&mut bytes);
    encoder.write_image(&[0, 255, 128], 3, 1, ExtendedColorType::from(ColorType::L8)).unwrap();
    assert_eq!(decode(&bytes).unwrap().rgba, [0, 0, 0, 255, 255, 255, 255, 255, 128, 128, 128, 255]);
    let bits = decode(b"P4\n8 1\n\xA5").unwrap();
    assert_eq!(bits.rgba.iter().step_by(4).copied().collect::<Vec<_>>(), [0, 255, 0, 255, 255, 0, 255, 0]);
}

/// A profile of a few bytes that would unpack to gigabytes was unpacked, whatever the limits.
#[test]
fn the_colour_profile_of_a_png_is_not_unpacked() {
    let plain = encoded(&sample(), ImageFormat::Png);
    let content = [&b"name\0\0"[..], &[0x5A; 100]].concat();
    let mut wrong = plain[..33].to_vec();
    wrong.extend((content.len() as u32).to_be_bytes());
    wrong.extend(b"iCCP");
    wrong.extend(content);
    // The sum is wrong too: the part is not even looked at.
    wrong.extend([0; 4]);
    wrong.extend(&plain[33..]);
    assert_eq!(decode(&wrong), decode(&plain));
}

/// The mark of an end in a thumbnail was taken for the picture's, and one far from the end of the file was not found.
#[test]
fn a_jpeg_with_a_thumbnail_is_whole_when_the_picture_itself_is() {
    let plain = encoded(&DynamicImage::ImageRgb8(sample().to_rgb8()), ImageFormat::Jpeg);
    let thumbnail = [0xFF, 0xEC, 0, 6, 0xFF, 0xD8, 0xFF, 0xD9];
    let whole = [&plain[..2], &thumbnail, &plain[2..], &[7; 100_000]].concat();
    assert_eq!(decode(&whole), decode(&plain));
    assert!(decode(&whole[..plain.len() + thumbnail.len() - 2]).is_err());
}
