#include "modules/hair/techniques.h"

#include <algorithm>
#include <array>
#include <string>

namespace vellus::hair {

namespace {

constexpr std::array<std::string_view, 2> kOpacity = {"dither", "dither_still"};
constexpr std::array<std::string_view, 2> kShadow = {"none", "pcf_exponential"};
constexpr std::array<std::string_view, kScatteringTechniques> kScattering = {
    "karis",    "kajiya_kay",   "marschner", "karis_rational", "series_gaussian", "series_a2",
    "series_b", "series_exact", "deon"};
constexpr std::array<std::string_view, 3> kMultiple = {"none", "fake_normal", "dual"};
constexpr std::array<std::string_view, 2> kEnvironment = {"none", "sh"};

constexpr std::array<std::string_view, 5> kAxes = {"opacity", "shadow", "scattering", "multiple",
                                                   "environment"};
constexpr std::array<std::span<const std::string_view>, 5> kIds = {kOpacity, kShadow, kScattering,
                                                                   kMultiple, kEnvironment};

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

std::span<const std::string_view> axes() {
    return kAxes;
}

std::span<const std::string_view> technique_ids(std::string_view axis) {
    const size_t index = index_of(kAxes, axis);
    return index < kAxes.size() ? kIds[index] : std::span<const std::string_view>();
}

Result<void> set_technique(HairTechniques& techniques, std::string_view axis, std::string_view id) {
    const size_t index = index_of(kAxes, axis);
    if (index == kAxes.size()) {
        return Error{fmt::format("no such axis '{}'", axis), "technique",
                     "choose one of: " + joined(kAxes)};
    }
    const size_t value = index_of(kIds[index], id);
    if (value == kIds[index].size()) {
        return Error{fmt::format("no technique '{}' on the axis '{}'", id, axis), "technique",
                     "choose one of: " + joined(kIds[index])};
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
    return index < kAxes.size() ? kIds[index][chosen[index]] : std::string_view();
}

}  // namespace vellus::hair
