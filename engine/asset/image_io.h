#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/asset/image.h"
#include "engine/platform/result.h"

namespace vellus::asset {

/// Larger images are refused: at most this many pixels per side, and in all.
constexpr uint32_t kMaxImageSide = 32768;
constexpr uint64_t kMaxImagePixels = uint64_t{1} << 27U;

/// PNG or JPEG (told apart by content) as 8-bit RGBA; 16-bit PNGs are rounded to 8 bits.
Result<Image> load_image(const std::filesystem::path& path);
Result<Image> decode_image(std::span<const std::byte> bytes, uint64_t max_pixels = kMaxImagePixels);

/// Colours decoded from sRGB.
ImageF to_linear(const Image& image);

/// Radiance .hdr, OpenEXR, PNG or JPEG (told apart by content) as linear RGBA. Every value that
/// comes back is finite and >= 0: NaN and negative values become 0, infinity becomes 65504 (the
/// largest half); ImageF counts them.
Result<ImageF> load_image_f(const std::filesystem::path& path);
Result<ImageF> decode_image_f(std::span<const std::byte> bytes);

/// Radiance .hdr: both run-length codings and flat pixels, all eight orientations, EXPOSURE and
/// COLORCORR undone, XYZE converted to Rec. 709. Alpha is 1.
Result<ImageF> decode_hdr(std::span<const std::byte> bytes);

/// OpenEXR, every compression, scanline or tiled (first part, full level): R, G, B, A, or Y, or Y
/// with RY and BY, half or float; the data window only.
Result<ImageF> decode_exr(std::span<const std::byte> bytes);

/// The files that the save functions write, in memory.
Result<std::vector<std::byte>> encode_png(const Image& image);
Result<std::vector<std::byte>> encode_exr(const ImageF& image);
Result<std::vector<std::byte>> encode_hdr(const ImageF& image);

/// Atomic, and the same bytes for the same pixels.
Result<void> save_png(const std::filesystem::path& path, const Image& image);

/// Float RGBA, ZIP compressed; atomic, and the same bytes for the same pixels.
Result<void> save_exr(const std::filesystem::path& path, const ImageF& image);

/// Radiance RGBE (8-bit mantissas, so about 1 % per channel); alpha is lost. Atomic.
Result<void> save_hdr(const std::filesystem::path& path, const ImageF& image);

}  // namespace vellus::asset
