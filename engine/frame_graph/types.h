#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "engine/gpu/format.h"
#include "engine/platform/source_line.h"

namespace vellus::graph {

constexpr uint32_t kNoIndex = ~0U;

/// A 2D image: size in pixels of mip 0, array layers, mip levels.
struct ImageDesc {
    gpu::Format format = gpu::Format::kUndefined;
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t layers = 1;
    uint32_t mips = 1;
    bool operator==(const ImageDesc&) const = default;
};

struct BufferDesc {
    uint64_t bytes = 0;
    bool operator==(const BufferDesc&) const = default;
};

/// One version of a resource of one description. Writing returns the next version; reading names
/// the version whose content is wanted. `version` numbers all versions of the description.
struct Handle {
    uint32_t index = kNoIndex;
    uint32_t version = kNoIndex;
    uint32_t generation = 0;
    bool operator==(const Handle&) const = default;
    explicit operator bool() const { return index != kNoIndex; }
};
struct ImageHandle : Handle {};
struct BufferHandle : Handle {};

/// Last frame's image and the one to write this frame, which the next frame gets as `previous`.
struct History {
    ImageHandle previous;
    ImageHandle next;
};

/// What kind of commands a pass records. A host pass runs on the CPU once all earlier GPU work is
/// done.
enum class PassKind : uint8_t { kCompute, kRaster, kTransfer, kHost };

/// What an access may touch.
enum class Target : uint8_t { kColorImage, kDepthImage, kTransientBuffer, kImportedBuffer };

/// How a pass touches a resource: decides stages, access bits, layout and usage (access.h).
enum class Access : uint8_t {
    kNone,
    kSampledCompute,            ///< sampled image, compute shader
    kSampledFragment,           ///< sampled image, fragment shader
    kSampledVertex,             ///< sampled image, vertex shader
    kStorageRead,               ///< storage image or buffer, compute shader
    kStorageWrite,              ///< the same, written only
    kStorageReadWrite,          ///< the same, read and written (atomics too)
    kGraphicsStorageRead,       ///< storage image or buffer, vertex and fragment shader
    kFragmentStorageWrite,      ///< storage image or buffer, fragment shader
    kFragmentStorageReadWrite,  ///< the same, read and written (atomics too)
    kColorAttachment,           ///< through PassBuilder::color
    kDepthAttachment,           ///< through PassBuilder::depth
    kDepthReadOnly,             ///< depth test without write; not sampled by the same pass
    kVertexBuffer,
    kIndexBuffer,
    kIndirect,
    kTransferRead,
    kTransferWrite,
    kHostRead,
    kPresent,
    kCount,
};

/// A rectangle of subresources; the default is all of them.
struct ImageRange {
    static constexpr uint16_t kAll = 0xffff;
    uint16_t mip = 0;
    uint16_t mips = kAll;
    uint16_t layer = 0;
    uint16_t layers = kAll;
    bool operator==(const ImageRange&) const = default;
};

/// What a write does with the content the resource had before.
enum class Load : uint8_t {
    kKeep,     ///< keeps what is not overwritten: the writer of the previous version is needed
    kClear,    ///< sets all of the range to a value first (attachments only)
    kDiscard,  ///< every pixel is written, or what is not may be anything
};

struct LoadOp {
    Load op = Load::kKeep;
    std::array<uint32_t, 4> bits{};  ///< clear value: float or uint32 by format; depth in [0]
};
constexpr LoadOp keep() {
    return {};
}
constexpr LoadOp discard() {
    return {Load::kDiscard, {}};
}
constexpr LoadOp clear(float r, float g = 0, float b = 0, float a = 0) {
    return {Load::kClear,
            {std::bit_cast<uint32_t>(r), std::bit_cast<uint32_t>(g), std::bit_cast<uint32_t>(b),
             std::bit_cast<uint32_t>(a)}};
}
constexpr LoadOp clear_uint(uint32_t value) {
    return {Load::kClear, {value, value, value, value}};
}

}  // namespace vellus::graph
