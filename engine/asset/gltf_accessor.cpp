#include <cmath>
#include <cstring>

#include "engine/asset/gltf_context.h"

// glTF 2.0 specification, chapter 3.6 (accessors, sparse accessors, data alignment).
namespace vellus::asset::detail {
namespace {

constexpr const char* kExportAgain = "export it again";

size_t component_size(int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

/// Columns of a matrix start at multiples of four bytes.
size_t element_size(const tinygltf::Accessor& accessor) {
    const size_t size = component_size(accessor.componentType);
    const auto column = [size](size_t rows) { return (rows * size + 3) / 4 * 4; };
    switch (accessor.type) {
        case TINYGLTF_TYPE_MAT2:
            return 2 * column(2);
        case TINYGLTF_TYPE_MAT3:
            return 3 * column(3);
        case TINYGLTF_TYPE_MAT4:
            return 4 * column(4);
        default:
            return size * static_cast<size_t>(tinygltf::GetNumComponentsInType(
                              static_cast<uint32_t>(accessor.type)));
    }
}

template <class T>
T load(const std::byte* at) {
    T value{};
    std::memcpy(&value, at, sizeof(T));
    return value;
}

template <class T>
float scaled(const std::byte* at, bool normalized) {
    const auto value = static_cast<float>(load<T>(at));
    return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f)
                      : value;
}

float component(const std::byte* at, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled<int8_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled<uint8_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled<int16_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled<uint16_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return scaled<uint32_t>(at, normalized);
        default:
            return load<float>(at);
    }
}

uint32_t unsigned_component(const std::byte* at, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<uint16_t>(at);
        default:
            return load<uint32_t>(at);
    }
}

bool is_unsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Bytes the last element needs: padding after the last column of a matrix may be missing.
size_t last_element_size(const tinygltf::Accessor& accessor) {
    const size_t size = component_size(accessor.componentType);
    const auto padding = [size](size_t rows) { return (4 - rows * size % 4) % 4; };
    const bool matrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3;
    return element_size(accessor) -
           (matrix ? padding(accessor.type == TINYGLTF_TYPE_MAT2 ? 2 : 3) : 0);
}

/// Whether `count` elements, `stride` apart, fit into `length` bytes from `offset`; without
/// overflow.
bool fits(uint64_t offset, uint64_t count, uint64_t stride, uint64_t element, uint64_t length) {
    return offset <= length && element <= length - offset &&
           count - 1 <= (length - offset - element) / stride;
}

void check_sparse(const tinygltf::Accessor& accessor, const std::string& pointer,
                  const Context& context) {
    const auto& sparse = accessor.sparse;
    const auto& views = context.model.bufferViews;
    const auto count = static_cast<uint64_t>(sparse.count);
    if (count > accessor.count) {
        refuse(pointer + "/count",
               fmt::format("{} sparse values for {} elements", count, accessor.count),
               kExportAgain);
    }
    if (!is_unsigned(sparse.indices.componentType)) {
        refuse(pointer + "/indices/componentType",
               fmt::format("{} is no unsigned type", sparse.indices.componentType), kExportAgain);
    }
    const uint64_t index_size = component_size(sparse.indices.componentType);
    const uint64_t value_size = element_size(accessor);
    if (!fits(static_cast<uint64_t>(sparse.indices.byteOffset), count, index_size, index_size,
              views[static_cast<size_t>(sparse.indices.bufferView)].byteLength)) {
        refuse(pointer + "/indices", "more than its buffer view holds", kExportAgain);
    }
    if (!fits(static_cast<uint64_t>(sparse.values.byteOffset), count, value_size, value_size,
              views[static_cast<size_t>(sparse.values.bufferView)].byteLength)) {
        refuse(pointer + "/values", "more than its buffer view holds", kExportAgain);
    }
}

void check_accessor(const tinygltf::Accessor& accessor, bool has_offset, const std::string& pointer,
                    Context& context) {
    if (component_size(accessor.componentType) == 0) {
        refuse(pointer + "/componentType",
               fmt::format("{} is no component type", accessor.componentType), kExportAgain);
    }
    if (accessor.normalized && accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
        context.warn(pointer + "/normalized", "means nothing for floats");
    }
    if (accessor.sparse.isSparse) {
        check_sparse(accessor, pointer + "/sparse", context);
    }
    if (accessor.bufferView < 0) {
        if (has_offset) {
            context.warn(pointer + "/byteOffset", "means nothing without a buffer view");
        }
        return;
    }
    const auto& view = context.model.bufferViews[static_cast<size_t>(accessor.bufferView)];
    const size_t element = element_size(accessor);
    if (view.byteStride != 0 && view.byteStride < element) {
        refuse(pointer,
               fmt::format("elements of {} bytes, {} bytes apart", element, view.byteStride),
               kExportAgain);
    }
    const size_t stride = view.byteStride != 0 ? view.byteStride : element;
    if (!fits(accessor.byteOffset, accessor.count, stride, last_element_size(accessor),
              view.byteLength)) {
        refuse(pointer,
               fmt::format("{} elements of {} bytes from byte {} are more than the {} bytes of its "
                           "buffer view",
                           accessor.count, element, accessor.byteOffset, view.byteLength),
               kExportAgain);
    }
    if ((accessor.byteOffset + view.byteOffset) % component_size(accessor.componentType) != 0) {
        context.warn(pointer + "/byteOffset", "not aligned to its component type");
    }
}

void check_view(const tinygltf::BufferView& view, const std::string& pointer,
                const Context& context) {
    const Json& buffer = context.doc["buffers"][static_cast<size_t>(view.buffer)];
    const auto size = buffer["byteLength"].get<uint64_t>();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset) {
        refuse(pointer,
               fmt::format("bytes {} to {} of a buffer of {} bytes", view.byteOffset,
                           view.byteOffset + view.byteLength, size),
               kExportAgain);
    }
    if (view.byteStride > view.byteLength) {
        refuse(pointer + "/byteStride",
               fmt::format("{} in a view of {} bytes", view.byteStride, view.byteLength),
               kExportAgain);
    }
}

/// Calls `visit(element index, pointer to element)` for the stored elements, then for the sparse
/// ones.
template <class Visit>
void for_each_element(const Context& context, const tinygltf::Accessor& accessor,
                      const std::string& pointer, Visit visit) {
    const size_t element = element_size(accessor);
    if (accessor.bufferView >= 0) {
        const auto view = static_cast<size_t>(accessor.bufferView);
        const Bytes bytes = buffer_view(context, view, pointer).subspan(accessor.byteOffset);
        const size_t stride = context.model.bufferViews[view].byteStride;
        for (size_t i = 0; i < accessor.count; ++i) {
            visit(i, bytes.data() + i * (stride != 0 ? stride : element));
        }
    }
    if (!accessor.sparse.isSparse) {
        return;
    }
    const auto& sparse = accessor.sparse;
    const Bytes indices =
        buffer_view(context, static_cast<size_t>(sparse.indices.bufferView), pointer)
            .subspan(static_cast<size_t>(sparse.indices.byteOffset));
    const Bytes values =
        buffer_view(context, static_cast<size_t>(sparse.values.bufferView), pointer)
            .subspan(static_cast<size_t>(sparse.values.byteOffset));
    int64_t last = -1;
    for (size_t i = 0; i < static_cast<size_t>(sparse.count); ++i) {
        const uint32_t index =
            unsigned_component(indices.data() + i * component_size(sparse.indices.componentType),
                               sparse.indices.componentType);
        if (index >= accessor.count || int64_t{index} <= last) {
            refuse(pointer + "/sparse/indices",
                   fmt::format("index {} of {} elements, after {}", index, accessor.count, last),
                   kExportAgain);
        }
        last = index;
        visit(index, values.data() + i * element);
    }
}

const tinygltf::Accessor& typed_accessor(const Context& context, int accessor, int components,
                                         const std::string& pointer) {
    if (accessor_components(context, accessor) != components) {
        refuse(pointer,
               fmt::format("accessor {} has {} components per element instead of {}", accessor,
                           accessor_components(context, accessor), components),
               kExportAgain);
    }
    return context.model.accessors[static_cast<size_t>(accessor)];
}

}  // namespace

Bytes buffer_view(const Context& context, size_t view, const std::string& pointer) {
    const tinygltf::BufferView& v = context.model.bufferViews[view];
    const auto& bytes = context.buffers[static_cast<size_t>(v.buffer)];
    if (!bytes) {
        refuse(pointer, fmt::format("needs buffer {}, which has no data", v.buffer), kExportAgain);
    }
    return bytes->subspan(v.byteOffset, v.byteLength);
}

void check_accessors(Context& context) {
    for (size_t i = 0; i < context.model.bufferViews.size(); ++i) {
        check_view(context.model.bufferViews[i], fmt::format("/bufferViews/{}", i), context);
    }
    for (size_t i = 0; i < context.model.accessors.size(); ++i) {
        check_accessor(context.model.accessors[i],
                       context.doc["accessors"][i].contains("byteOffset"),
                       fmt::format("/accessors/{}", i), context);
    }
}

size_t accessor_count(const Context& context, int accessor) {
    return context.model.accessors[static_cast<size_t>(accessor)].count;
}

int accessor_components(const Context& context, int accessor) {
    return tinygltf::GetNumComponentsInType(
        static_cast<uint32_t>(context.model.accessors[static_cast<size_t>(accessor)].type));
}

bool accessor_is_float(const Context& context, int accessor) {
    return context.model.accessors[static_cast<size_t>(accessor)].componentType ==
           TINYGLTF_COMPONENT_TYPE_FLOAT;
}

std::vector<float> read_floats(Context& context, int accessor, int components,
                               const std::string& pointer) {
    const auto& a = typed_accessor(context, accessor, components, pointer);
    const auto width = static_cast<size_t>(components);
    context.charge(a.count, sizeof(float) * width, pointer);
    std::vector<float> values(a.count * width);
    const size_t size = component_size(a.componentType);
    for_each_element(context, a, pointer, [&](size_t i, const std::byte* element) {
        for (size_t c = 0; c < width; ++c) {
            const float value = component(element + c * size, a.componentType, a.normalized);
            if (!std::isfinite(value)) {
                refuse(pointer, fmt::format("element {} of accessor {} is not finite", i, accessor),
                       kExportAgain);
            }
            values[i * width + c] = value;
        }
    });
    return values;
}

std::vector<uint32_t> read_unsigned(Context& context, int accessor, int components,
                                    const std::string& pointer) {
    const auto& a = typed_accessor(context, accessor, components, pointer);
    if (!is_unsigned(a.componentType) || a.normalized) {
        refuse(pointer, fmt::format("accessor {} is not of plain unsigned integers", accessor),
               kExportAgain);
    }
    const auto width = static_cast<size_t>(components);
    context.charge(a.count, sizeof(uint32_t) * width, pointer);
    std::vector<uint32_t> values(a.count * width);
    const size_t size = component_size(a.componentType);
    for_each_element(context, a, pointer, [&](size_t i, const std::byte* element) {
        for (size_t c = 0; c < width; ++c) {
            values[i * width + c] = unsigned_component(element + c * size, a.componentType);
        }
    });
    return values;
}

}  // namespace vellus::asset::detail
