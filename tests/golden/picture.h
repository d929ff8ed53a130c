#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/asset/image.h"

namespace vellus::test {

/// Where the running test keeps its scenes and pictures: no other test's, so that all may run at
/// once.
std::filesystem::path work_folder();

/// Runs vellus_demo headless with validation and returns the pictures it saved, in order; records a
/// test failure, and returns none, where it does not end well.
std::vector<asset::Image> render(const std::string& name,
                                 const std::vector<std::string>& arguments);

/// How far apart two pictures are, in steps of 8 bits.
struct Difference {
    double mean = 0.0;
    double large_share = 0.0;  ///< share of pixels with a channel more than 24 steps off
};
Difference compare(const asset::Image& a, const asset::Image& b);

/// 1 where two pictures differ by more than 6 steps in a channel: what hair changed.
std::vector<uint8_t> changed(const asset::Image& a, const asset::Image& b);

/// Share of the closed mask (grown, then shrunk, by `radius` pixels) that is not in the mask.
double hole_share(const std::vector<uint8_t>& mask, uint32_t width, int radius);

/// Share of the closed mask (radius 4) in gaps of 3x3 pixels or more: bald spots, not dither.
double bald_share(const std::vector<uint8_t>& mask, uint32_t width);

/// Mean over the mask of each pixel's standard deviation over the pictures, in steps of 8 bits.
double flicker(const std::vector<asset::Image>& pictures, const std::vector<uint8_t>& mask);

}  // namespace vellus::test
