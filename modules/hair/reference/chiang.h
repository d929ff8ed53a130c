#pragma once

#include <array>
#include <glm/glm.hpp>

#include "modules/hair/reference/longitudinal.h"

namespace vellus::hair::reference {

/// R, TT, TRT and the residual lobe, which holds all that is reflected inside more than once.
constexpr int kChiangLobes = 4;

/// A fibre as Chiang et al. 2016 describe it ("A Practical and Controllable Hair and Fur Model for
/// Production Path Tracing", Eurographics 2016).
struct ChiangFibre {
    glm::dvec3 sigma_a{0.0};  ///< absorption per fibre radius, linear RGB
    double eta = 1.55;
    std::array<double, kChiangLobes> variance{};  ///< longitudinal v of each lobe, > 0
    /// s of the logistic distributions of R, TT and TRT, radians.
    std::array<double, kChiangLobes - 1> azimuthal_scale{0.1, 0.1, 0.1};
    double tilt = 0.0;      ///< of the cuticle, radians; as `shift` in karis.glsl
    double specular = 1.0;  ///< factor on R; 1 is physical
};

/// Perceptual roughnesses beta_m (along) and beta_n (around) in [0, 1]: eq. 7 and 8.
ChiangFibre chiang_fibre(const glm::dvec3& sigma_a, double beta_m, double beta_n);

/// Scales of the logistics that Karis's fits of TT and TRT stand for, radians.
constexpr double kKarisScaleTt = 0.35;
constexpr double kKarisScaleTrt = 0.15;

/// The parameters of karis.glsl: C = e^(-4 sigma_a) (melanin.glsl), β = r², r²/2, 2 r² in R, TT,
/// TRT, his azimuthal scales there. His R has none; 0.1 leaves its smooth lobe as it is.
ChiangFibre chiang_from_karis(const glm::dvec3& base_color, double roughness, double tilt);

/// Near-field scattering for one incoming ray: where it hits the fibre's width and how steeply.
/// Inclinations and azimuths as in karis.glsl; radiance and light directions both leave the fibre.
/// `evaluate` holds the fibre's cosine: a beam of irradiance E (across it) sends f E to the eye and
/// ∫ f dω is the albedo.
class ChiangScattering {
  public:
    /// Offset h in [-1, 1] of the point from the axis: sin γo, γo the angle from the surface normal
    /// to the eye, counter-clockwise about the tangent.
    ChiangScattering(const ChiangFibre& fibre, double h, Inclination eye);

    /// f towards a light at inclination `i` and azimuth `phi` (eye at 0), 1/sr.
    [[nodiscard]] glm::dvec3 evaluate(Inclination i, double phi) const;
    /// Density of `sample` at that direction, 1/sr.
    [[nodiscard]] double pdf(Inclination i, double phi) const;

    struct Sample {
        Inclination i;
        double phi = 0.0;
        double pdf = 0.0;
        glm::dvec3 weight{0.0};  ///< f / pdf; 0 where nothing scatters
    };
    /// A direction from four uniform numbers in [0, 1).
    [[nodiscard]] Sample sample(const glm::dvec4& u) const;

    /// The share of each lobe; their sum is the albedo (eq. 12 and 13).
    [[nodiscard]] const std::array<glm::dvec3, kChiangLobes>& attenuation() const {
        return attenuation_;
    }
    [[nodiscard]] glm::dvec3 albedo() const;

  private:
    /// Longitudinal times azimuthal distribution of a lobe, 1/sr; integrates to 1.
    [[nodiscard]] double lobe(int p, Inclination i, double phi) const;

    std::array<double, kChiangLobes> variance_;
    std::array<double, kChiangLobes - 1> scale_;
    std::array<Inclination, kChiangLobes> tilted_{};  // the eye's, turned by the cuticle
    std::array<double, kChiangLobes> center_{};       // azimuth of the undisturbed ray
    std::array<glm::dvec3, kChiangLobes> attenuation_{};
    std::array<double, kChiangLobes> choice_{};  // probability of each lobe
};

/// Density at `phi` of the logistic distribution of scale `s` cut off at ±π (eq. 10).
double trimmed_logistic(double phi, double s);

}  // namespace vellus::hair::reference
