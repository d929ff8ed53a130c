#include "modules/hair/cards/cluster.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "engine/platform/jobs.h"
#include "modules/hair/cards/strand_path.h"

namespace vellus::hair {

namespace {

constexpr size_t kPieces = 8;
/// Of strands that weave, which eight pieces do not see.
constexpr size_t kFinePieces = 24;
constexpr size_t kSamplesPerPiece = 4;
/// Strands of a cluster that are so many times as far apart (squared) in fine pieces weave.
constexpr double kWeaving = 1.5;
constexpr int kRounds = 24;
constexpr size_t kGrain = 128;

/// Mean positions of the pieces of a strand.
template <size_t Pieces>
using Feature = std::array<float, 3 * Pieces>;

template <size_t Pieces>
Feature<Pieces> feature_of(const StrandData& strands, size_t strand) {
    Feature<Pieces> feature{};
    for (size_t i = 0; i < Pieces * kSamplesPerPiece; ++i) {
        const float fraction =
            (static_cast<float>(i) + 0.5f) / static_cast<float>(Pieces * kSamplesPerPiece);
        const glm::vec3 p = strand_position(strands, strand, fraction);
        float* piece = &feature[i / kSamplesPerPiece * 3];
        for (int axis = 0; axis < 3; ++axis) piece[axis] += p[axis] / kSamplesPerPiece;
    }
    return feature;
}

template <size_t Pieces>
std::vector<Feature<Pieces>> features_of(const StrandData& strands) {
    std::vector<Feature<Pieces>> features(strands.strand_count());
    parallel_ranges(features.size(), kGrain, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) features[i] = feature_of<Pieces>(strands, i);
    });
    return features;
}

template <class Feature>
float squared_distance(const Feature& a, const Feature& b) {
    float sum = 0.0f;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/// Strands that lie farthest from each other, from the one farthest from the mean on.
template <class Feature>
std::vector<Feature> farthest_strands(const std::vector<Feature>& features, uint32_t count) {
    std::vector<float> nearest(features.size(), std::numeric_limits<float>::max());
    std::vector<Feature> chosen;
    Feature last{};
    for (size_t i = 0; i < last.size(); ++i) {
        double sum = 0.0;
        for (const Feature& feature : features) sum += feature[i];
        last[i] = static_cast<float>(sum / static_cast<double>(features.size()));
    }
    while (chosen.size() < count) {
        parallel_ranges(features.size(), kGrain * 8, [&](size_t first, size_t end) {
            for (size_t i = first; i < end; ++i) {
                const float distance = squared_distance(features[i], last);
                nearest[i] = chosen.empty() ? distance : std::min(nearest[i], distance);
            }
        });
        const auto farthest = std::ranges::max_element(nearest);
        if (*farthest <= 0.0f && !chosen.empty()) break;
        last = features[static_cast<size_t>(farthest - nearest.begin())];
        if (chosen.empty()) std::ranges::fill(nearest, std::numeric_limits<float>::max());
        chosen.push_back(last);
    }
    return chosen;
}

/// Labels each strand with the closest centre; true where any label changed.
template <class Feature>
bool assign(const std::vector<Feature>& features, const std::vector<Feature>& centers,
            std::vector<uint32_t>& labels, std::vector<float>& distances) {
    std::vector<uint8_t> changed(features.size(), 0);
    parallel_ranges(features.size(), kGrain, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            float best = std::numeric_limits<float>::max();
            uint32_t label = 0;
            for (uint32_t c = 0; c < centers.size(); ++c) {
                const float distance = squared_distance(features[i], centers[c]);
                if (distance >= best) continue;
                best = distance;
                label = c;
            }
            changed[i] = labels[i] != label ? 1 : 0;
            labels[i] = label;
            distances[i] = best;
        }
    });
    return std::ranges::any_of(changed, [](uint8_t c) { return c != 0; });
}

/// Centres to the means of their strands; one that lost all of them takes the strand that lies
/// farthest from its own.
template <class Feature>
void move_centers(const std::vector<Feature>& features, const std::vector<uint32_t>& labels,
                  std::vector<float>& distances, std::vector<Feature>& centers) {
    std::vector<std::array<double, std::tuple_size_v<Feature>>> sums(centers.size());
    std::vector<uint32_t> counts(centers.size(), 0);
    for (size_t i = 0; i < features.size(); ++i) {
        ++counts[labels[i]];
        for (size_t k = 0; k < features[i].size(); ++k) sums[labels[i]][k] += features[i][k];
    }
    for (size_t c = 0; c < centers.size(); ++c) {
        if (counts[c] == 0) {
            const auto farthest = std::ranges::max_element(distances);
            centers[c] = features[static_cast<size_t>(farthest - distances.begin())];
            *farthest = 0.0f;
            continue;
        }
        for (size_t k = 0; k < centers[c].size(); ++k) {
            centers[c][k] = static_cast<float>(sums[c][k] / counts[c]);
        }
    }
}

/// Labels without gaps, in the order of each cluster's first strand.
void renumber(std::vector<uint32_t>& labels, size_t centers) {
    constexpr uint32_t kUnused = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> number(centers, kUnused);
    uint32_t next = 0;
    for (uint32_t& label : labels) {
        if (number[label] == kUnused) number[label] = next++;
        label = number[label];
    }
}

/// Lloyd's k-means.
template <class Feature>
std::vector<uint32_t> k_means(const std::vector<Feature>& features, uint32_t count) {
    std::vector<uint32_t> labels(features.size(), 0);
    std::vector<Feature> centers = farthest_strands(features, count);
    std::vector<float> distances(features.size());
    for (int round = 0; round < kRounds; ++round) {
        if (!assign(features, centers, labels, distances) && round > 0) break;
        move_centers(features, labels, distances, centers);
    }
    assign(features, centers, labels, distances);
    renumber(labels, centers.size());
    return labels;
}

/// Mean square distance of pieces from the mean of their cluster's.
template <class Feature>
double spread(const std::vector<Feature>& features, const std::vector<uint32_t>& labels) {
    std::vector<float> distances(features.size(), 0.0f);
    std::vector<Feature> centers(1 + *std::ranges::max_element(labels));
    move_centers(features, labels, distances, centers);
    double sum = 0.0;
    for (size_t i = 0; i < features.size(); ++i) {
        sum += static_cast<double>(squared_distance(features[i], centers[labels[i]]));
    }
    return 3.0 * sum / static_cast<double>(features.size() * std::tuple_size_v<Feature>);
}

}  // namespace

std::vector<uint32_t> cluster_strands(const StrandData& strands, uint32_t count) {
    if (strands.strand_count() == 0 || count <= 1) {
        return std::vector<uint32_t>(strands.strand_count(), 0);
    }
    const auto features = features_of<kPieces>(strands);
    std::vector<uint32_t> labels = k_means(features, count);
    const auto fine = features_of<kFinePieces>(strands);
    if (spread(fine, labels) > kWeaving * spread(features, labels)) labels = k_means(fine, count);
    return labels;
}

}  // namespace vellus::hair
