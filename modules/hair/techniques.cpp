#include "modules/hair/techniques.h"

#include <algorithm>
#include <array>
#include <string>

namespace vellus::hair {

namespace {

constexpr std::array<std::string_view, 2> kOpacity = {"dither", "dither_still"};
constexpr std::array<std::string_view, 3> kShadow = {"none", "pcf_exponential", "deep_opacity"};
constexpr std::array<std::string_view, 3> kMultiple = {"none", "fake_normal", "dual"};
constexpr std::array<std::string_view, 3> kEnvironment = {"none", "sh", "sh_depth"};

constexpr std::array<std::string_view, 5> kAxes = {"opacity", "shadow", "scattering", "multiple",
                                                   "environment"};

constexpr size_t kMostScattering = 64;

/// The scattering axis, which the process may widen.
struct ScatteringTable {
    std::array<std::string_view, kMostScattering> ids = {
        "karis",    "kajiya_kay",   "marschner", "karis_rational", "series_gaussian", "series_a2",
        "series_b", "series_exact", "deon"};
    std::array<gpu::EmbeddedShader, kMostScattering> stages{};
    size_t count = kScatteringTechniques;
};

ScatteringTable& scattering() {
    static ScatteringTable table;
    return table;
}

std::span<const std::string_view> ids_of(size_t axis) {
    switch (axis) {
        case 0:
            return kOpacity;
        case 1:
            return kShadow;
        case 2:
            return std::span(scattering().ids).first(scattering().count);
        case 3:
            return kMultiple;
        default:
            return kEnvironment;
    }
}

std::string joined(std::span<const std::string_view> words) {
    std::string line;
    for (const std::string_view word : words) {
        line += line.empty() ? "" : ", ";
        line += word;
    }
    return line;
}

size_t index_of(std::span<const std::string_view> words, std::string_view word) {
    return static_cast<size_t>(std::ranges::find(words, word) - words.begin());
}

}  // namespace

Result<ScatteringTechnique> add_scattering(std::string_view id, const gpu::EmbeddedShader& shade) {
    ScatteringTable& table = scattering();
    const auto ids = std::span(table.ids).first(table.count);
    if (std::ranges::find(ids, id) != ids.end()) {
        return Error{fmt::format("there is a technique '{}' already", id), "scattering",
                     "give it another id"};
    }
    if (table.count == kMostScattering) {
        return Error{fmt::format("no room for a technique '{}'", id), "scattering",
                     fmt::format("the axis holds {}", kMostScattering)};
    }
    table.ids[table.count] = id;
    table.stages[table.count] = shade;
    return static_cast<ScatteringTechnique>(table.count++);
}

const gpu::EmbeddedShader* added_stage(ScatteringTechnique technique) {
    const auto index = static_cast<size_t>(technique);
    return index < kScatteringTechniques ? nullptr : &scattering().stages[index];
}

std::span<const std::string_view> axes() {
    return kAxes;
}

std::span<const std::string_view> technique_ids(std::string_view axis) {
    const size_t index = index_of(kAxes, axis);
    return index < kAxes.size() ? ids_of(index) : std::span<const std::string_view>();
}

Result<void> set_technique(HairTechniques& techniques, std::string_view axis, std::string_view id) {
    const size_t index = index_of(kAxes, axis);
    if (index == kAxes.size()) {
        return Error{fmt::format("no such axis '{}'", axis), "technique",
                     "choose one of: " + joined(kAxes)};
    }
    const size_t value = index_of(ids_of(index), id);
    if (value == ids_of(index).size()) {
        return Error{fmt::format("no technique '{}' on the axis '{}'", id, axis), "technique",
                     "choose one of: " + joined(ids_of(index))};
    }
    switch (index) {
        case 0:
            techniques.opacity = static_cast<OpacityTechnique>(value);
            break;
        case 1:
            techniques.shadow = static_cast<ShadowTechnique>(value);
            break;
        case 2:
            techniques.scattering = static_cast<ScatteringTechnique>(value);
            break;
        case 3:
            techniques.multiple = static_cast<MultipleTechnique>(value);
            break;
        default:
            techniques.environment = static_cast<EnvironmentTechnique>(value);
            break;
    }
    return {};
}

Result<void> set_techniques(HairTechniques& techniques, const TechniqueIds& ids) {
    const std::array<const std::string*, 5> given = {&ids.opacity, &ids.shadow, &ids.scattering,
                                                     &ids.multiple, &ids.environment};
    for (size_t axis = 0; axis < kAxes.size(); ++axis) {
        if (given[axis]->empty()) continue;
        if (auto set = set_technique(techniques, kAxes[axis], *given[axis]); !set) return set;
    }
    return {};
}

std::string_view technique_id(const HairTechniques& techniques, std::string_view axis) {
    const std::array<size_t, 5> chosen = {
        static_cast<size_t>(techniques.opacity), static_cast<size_t>(techniques.shadow),
        static_cast<size_t>(techniques.scattering), static_cast<size_t>(techniques.multiple),
        static_cast<size_t>(techniques.environment)};
    const size_t index = index_of(kAxes, axis);
    return index < kAxes.size() ? ids_of(index)[chosen[index]] : std::string_view();
}

}  // namespace vellus::hair
