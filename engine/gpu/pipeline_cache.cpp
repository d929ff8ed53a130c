#include "engine/gpu/pipeline_cache.h"

#include <cstring>

#include "engine/platform/files.h"
#include "engine/platform/hash.h"
#include "engine/platform/log.h"

namespace vellus::gpu {

namespace {

struct Header {
    std::array<char, 8> magic{'V', 'E', 'L', 'L', 'U', 'S', 'P', '1'};
    uint64_t checksum = 0;
};

}  // namespace

std::filesystem::path pipeline_cache_file(const std::filesystem::path& folder,
                                          VkPhysicalDevice physical) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    const uint64_t uuid = fnv1a(std::as_bytes(std::span(properties.pipelineCacheUUID)));
    return folder / fmt::format("pipelines-{:04x}-{:04x}-{:016x}.bin", properties.vendorID,
                                properties.deviceID, uuid);
}

std::vector<std::byte> load_pipeline_cache(const std::filesystem::path& file) {
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return {};
    auto bytes = read_file(file);
    if (!bytes) {
        log_warning("pipeline cache not used: {}", bytes.error().message());
        return {};
    }
    Header header;
    const auto magic = header.magic;
    const bool whole = bytes->size() >= sizeof(Header);
    if (whole) std::memcpy(&header, bytes->data(), sizeof(Header));
    const auto data = std::span(*bytes).subspan(whole ? sizeof(Header) : 0);
    if (!whole || header.magic != magic || header.checksum != fnv1a(data)) {
        log_warning("pipeline cache not used: {}: damaged (it will be written anew)",
                    file.string());
        return {};
    }
    return {data.begin(), data.end()};
}

Result<void> save_pipeline_cache(const std::filesystem::path& file,
                                 std::span<const std::byte> data) {
    Header header;
    header.checksum = fnv1a(data);
    std::vector<std::byte> bytes(sizeof(Header) + data.size());
    std::memcpy(bytes.data(), &header, sizeof(Header));
    std::ranges::copy(data, bytes.begin() + sizeof(Header));
    return write_file(file, std::span<const std::byte>(bytes));
}

}  // namespace vellus::gpu
