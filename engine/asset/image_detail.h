#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "engine/asset/image_io.h"

// Shared by the image readers only.
namespace vellus::asset::detail {

/// A compressed file cannot hold more pixels than this per byte (deflate reaches 1032 bytes per
/// byte, a pixel may be one bit), so a header that claims more lies.
constexpr uint64_t kMaxPixelsPerByte = 8 * 1032;

/// The error for a size that is zero, over the limits, or not credible for
/// `file_bytes`.
std::optional<Error> check_size(uint64_t width, uint64_t height, uint64_t file_bytes,
                                uint64_t max_pixels = kMaxImagePixels);

/// Makes every value finite and >= 0 and counts what it changed in image.repairs.
void repair_pixels(ImageF& image);

bool is_png(std::span<const std::byte> bytes);
bool is_jpeg(std::span<const std::byte> bytes);
bool is_exr(std::span<const std::byte> bytes);
bool is_hdr(std::span<const std::byte> bytes);

Result<Image> decode_jpeg(std::span<const std::byte> bytes, uint64_t max_pixels);

}  // namespace vellus::asset::detail
