#pragma once

#include <vector>

#include "modules/hair/reference/fibre.h"

namespace vellus::hair::reference {

/// Marschner, Jensen, Cammarano, Worley, Hanrahan 2003, "Light Scattering from Human Hair Fibers",
/// in the convention of the other references: S here is the paper's S cos θi (∫ S dω_i is the
/// albedo) and M is half the paper's, which normalises over θh although the outgoing inclination
/// moves twice as fast; as printed a white furnace returns 2. The paper's S is reciprocal, tilted
/// or not.

/// How TRT's caustics, where dΦ/dh = 0 and N diverges, become finite glints (§5.2.3). Within
/// `width` (w_c) of the caustic the divergent lobe fades out and a Gaussian of deviation `width`
/// takes its place, which holds the energy of the offsets within Δh of the caustic's, Δh =
/// min(`most_offset`, 2 √(2 w_c / |Φ''|)), times `scale` (k_G). For η' >= 2 the two caustics have
/// met and the glint fades out over `fade` (Δη').
struct MarschnerGlint {
    double width = 0.26;
    double scale = 0.5;
    double fade = 0.3;
    double most_offset = 0.5;
};

/// Reflectance from Bravais's two indices (appendix B): perpendicular with η', parallel with η²/η',
/// which falls below 1 (total reflection where there is none) beyond θd of about 1.0.
double marschner_fresnel(double eta, double theta_d, double gamma_i);

/// A(p, h) with that Fresnel and the chord 2 cos γt / cos θt (printed: its square).
double marschner_attenuation(const Fibre& fibre, int p, double theta_d, double h);

/// All offsets h in [-1, 1] whose path of p leaves at azimuth φ (mod 2π): each monotone piece of Φ
/// is bracketed and solved with its exact inverse trigonometry, not the paper's cubic. p = 0, 1, 2.
std::vector<double> offsets_of_azimuth(int p, double modified, double phi);

/// N_p = ½ Σ_h A(p, h) / |dΦ/dh| in closed form: infinite at a caustic.
double marschner_azimuthal(const Fibre& fibre, int p, double theta_d, double phi);

/// TRT with its caustics replaced by glints: finite everywhere.
double marschner_trt(const Fibre& fibre, double theta_d, double phi, const MarschnerGlint& glint);

/// S of R + TT + TRT; longitudinal lobes are Gaussians of deviation beta/2 in θh - tilt/2, since
/// beta and tilt count outgoing inclination.
double marschner(const Fibre& fibre, double theta_i, double theta_r, double phi,
                 const MarschnerGlint& glint = {});

}  // namespace vellus::hair::reference
