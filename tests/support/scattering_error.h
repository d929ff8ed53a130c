#pragma once

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

#include "engine/platform/jobs.h"
#include "modules/hair/reference/deon.h"
#include "modules/hair/scattering/fibre.h"

namespace vellus::test {

/// How far a technique is from d'Eon's sum of lobes, over all pairs of inclinations and azimuths.
struct ScatteringError {
    double l1 = 0.0;             ///< Σ |S - S_ref| cos θi cos θr / Σ S_ref cos θi cos θr
    double furnace_least = 1e9;  ///< of ∫ S dω_i over the reference's own, over all θr
    double furnace_most = 0.0;
};

/// d'Eon's reference for one fibre on a grid of midpoints: `steps` inclinations each way,
/// `azimuths` in [0, π]; techniques are the shader's own functions.
class DeonGrid {
  public:
    DeonGrid(const hair::glsl::HairSurface& surface, const hair::FibreOptics& optics, int steps,
             int azimuths)
        : surface_(surface), steps_(steps), azimuths_(azimuths) {
        hair::fit_azimuthal(optics, shared_);
        hair::set_longitudinal(surface.roughness, surface.shift, shared_);
        fibre_ = hair::reference::karis_fibre(surface, 0);
        fibre_.eta = optics.eta;
        fibre_.azimuthal = {0.0, optics.detector_tt, optics.detector_trt};
        tabulate_azimuthal();
        values_.resize(size_t(steps) * steps * azimuths);
        parallel_ranges(steps, 1, [&](size_t first, size_t last) {
            for (size_t r = first; r < last; ++r) {
                for (int i = 0; i < steps_; ++i) fill(static_cast<int>(r), i);
            }
        });
    }

    [[nodiscard]] ScatteringError error(int technique) const {
        ScatteringError result;
        double difference = 0.0;
        double total = 0.0;
        std::mutex mutex;
        parallel_ranges(steps_, 1, [&](size_t first, size_t last) {
            for (size_t r = first; r < last; ++r) {
                double off = 0.0;
                double exact = 0.0;
                double mine = 0.0;
                row(technique, static_cast<int>(r), off, exact, mine);
                const std::scoped_lock lock(mutex);
                const double weight = std::cos(inclination(static_cast<int>(r)));
                difference += off * weight;
                total += exact * weight;
                result.furnace_least = std::min(result.furnace_least, mine / exact);
                result.furnace_most = std::max(result.furnace_most, mine / exact);
            }
        });
        result.l1 = difference / total;
        return result;
    }

  private:
    [[nodiscard]] double inclination(int i) const {
        return std::numbers::pi * ((i + 0.5) / steps_ - 0.5);
    }
    [[nodiscard]] double azimuth(int j) const { return std::numbers::pi * (j + 0.5) / azimuths_; }
    [[nodiscard]] const double* at(int r, int i) const {
        return values_.data() + (size_t(r) * steps_ + i) * azimuths_;
    }

    /// N_p by θr - θi in steps: there are few of those.
    void tabulate_azimuthal() {
        for (auto& table : azimuthal_) table.resize(size_t(2 * steps_ - 1) * azimuths_);
        parallel_ranges(2 * steps_ - 1, 4, [&](size_t first, size_t last) {
            for (size_t d = first; d < last; ++d) {
                const double theta_d =
                    0.5 * std::numbers::pi * (static_cast<double>(d) - steps_ + 1.0) / steps_;
                for (int p = 0; p < 3; ++p) {
                    std::vector<double> series;
                    if (p > 0) {
                        const double reach = 8.0 / fibre_.azimuthal[p];
                        series = hair::reference::deon_azimuthal_series(
                            fibre_, p, theta_d, 4 + static_cast<int>(reach));
                    }
                    for (int j = 0; j < azimuths_; ++j) {
                        azimuthal_[p][d * azimuths_ + j] =
                            p == 0 ? hair::reference::deon_azimuthal(fibre_, 0, theta_d, azimuth(j))
                                   : hair::reference::cosine_sum(series, azimuth(j));
                    }
                }
            }
        });
    }

    void fill(int r, int i) {
        double* out = values_.data() + (size_t(r) * steps_ + i) * azimuths_;
        for (int p = 0; p < 3; ++p) {
            const double m =
                hair::reference::deon_longitudinal(fibre_, p, inclination(i), inclination(r));
            const double* n = azimuthal_[p].data() + size_t(r - i + steps_ - 1) * azimuths_;
            for (int j = 0; j < azimuths_; ++j) out[j] += m * n[j];
        }
    }

    void row(int technique, int r, double& off, double& exact, double& mine) const {
        const double theta_r = inclination(r);
        const auto frame =
            hair::glsl::hair_frame({1, 0, 0}, glm::vec3(std::sin(theta_r), 0.0, std::cos(theta_r)));
        const auto eye = hair::glsl::hair_eye(shared_, frame);
        for (int i = 0; i < steps_; ++i) {
            const double theta_i = inclination(i);
            const double weight = std::cos(theta_i);
            for (int j = 0; j < azimuths_; ++j) {
                const glm::vec3 to_light(std::sin(theta_i), weight * std::sin(azimuth(j)),
                                         weight * std::cos(azimuth(j)));
                const double s =
                    hair::glsl::hair_bsdf(technique, shared_, surface_, frame, eye, to_light).x;
                off += weight * std::abs(s - at(r, i)[j]);
                exact += weight * at(r, i)[j];
                mine += weight * s;
            }
        }
    }

    hair::glsl::HairSurface surface_;
    hair::glsl::HairFibre shared_{};
    hair::reference::Fibre fibre_;
    int steps_;
    int azimuths_;
    std::vector<double> azimuthal_[3];
    std::vector<double> values_;
};

}  // namespace vellus::test
