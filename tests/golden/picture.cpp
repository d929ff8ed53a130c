#include "tests/golden/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/asset/image_io.h"
#include "tests/end_to_end/demo_process.h"

namespace vellus::test {

namespace {

namespace fs = std::filesystem;

/// Largest (or, negated, smallest) value of a square neighbourhood, one axis at a time.
std::vector<uint8_t> spread(const std::vector<uint8_t>& mask, int width, int radius, bool grow) {
    const int height = static_cast<int>(mask.size()) / width;
    const auto pass = [&](const std::vector<uint8_t>& from, int dx, int dy) {
        std::vector<uint8_t> to(from.size());
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                uint8_t value = grow ? 0 : 1;
                for (int step = -radius; step <= radius; ++step) {
                    const int sx = std::clamp(x + dx * step, 0, width - 1);
                    const int sy = std::clamp(y + dy * step, 0, height - 1);
                    const uint8_t other = from[sy * width + sx];
                    value = grow ? std::max(value, other) : std::min(value, other);
                }
                to[y * width + x] = value;
            }
        }
        return to;
    };
    return pass(pass(mask, 1, 0), 0, 1);
}

int channel_difference(const asset::Image& a, const asset::Image& b, size_t pixel) {
    int largest = 0;
    for (size_t c = 0; c < 3; ++c) {
        largest = std::max(largest, std::abs(a.rgba[pixel * 4 + c] - b.rgba[pixel * 4 + c]));
    }
    return largest;
}

}  // namespace

fs::path work_folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return fs::path(VELLUS_BINARY_DIR) / "golden" / test->test_suite_name() / test->name();
}

std::vector<asset::Image> render(const std::string& name,
                                 const std::vector<std::string>& arguments) {
    const fs::path folder = work_folder() / name;
    fs::remove_all(folder);
    std::vector<std::string> all = {VELLUS_DEMO, "--headless", "--validation", "--out",
                                    folder.string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ended ended = run(all);
    EXPECT_EQ(ended.status, 0) << ended.output;
    std::vector<fs::path> files;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code)) {
        if (entry.path().extension() == ".png") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    std::vector<asset::Image> pictures;
    for (const auto& file : files) {
        auto image = asset::load_image(file);
        EXPECT_TRUE(image);
        if (image) pictures.push_back(std::move(*image));
    }
    return pictures;
}

Difference compare(const asset::Image& a, const asset::Image& b) {
    Difference difference;
    const size_t pixels = size_t{a.width} * a.height;
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        const int step = channel_difference(a, b, pixel);
        difference.mean += step;
        difference.large_share += step > 24 ? 1.0 : 0.0;
    }
    difference.mean /= static_cast<double>(pixels);
    difference.large_share /= static_cast<double>(pixels);
    return difference;
}

std::vector<uint8_t> changed(const asset::Image& a, const asset::Image& b) {
    std::vector<uint8_t> mask(size_t{a.width} * a.height);
    for (size_t pixel = 0; pixel < mask.size(); ++pixel) {
        mask[pixel] = channel_difference(a, b, pixel) > 6 ? 1 : 0;
    }
    return mask;
}

double hole_share(const std::vector<uint8_t>& mask, uint32_t width, int radius) {
    const int w = static_cast<int>(width);
    const auto closed = spread(spread(mask, w, radius, true), w, radius, false);
    double holes = 0.0;
    double area = 0.0;
    for (size_t i = 0; i < mask.size(); ++i) {
        area += closed[i];
        holes += closed[i] > mask[i] ? 1.0 : 0.0;
    }
    return area > 0.0 ? holes / area : 1.0;
}

double bald_share(const std::vector<uint8_t>& mask, uint32_t width) {
    const int w = static_cast<int>(width);
    const auto closed = spread(spread(mask, w, 4, true), w, 4, false);
    std::vector<uint8_t> gaps(mask.size());
    for (size_t i = 0; i < mask.size(); ++i) gaps[i] = closed[i] > mask[i] ? 1 : 0;
    const auto spots = spread(spread(gaps, w, 1, false), w, 1, true);
    const auto count = [](const std::vector<uint8_t>& m) {
        return static_cast<double>(std::ranges::count(m, uint8_t{1}));
    };
    return count(closed) > 0.0 ? count(spots) / count(closed) : 1.0;
}

double flicker(const std::vector<asset::Image>& pictures, const std::vector<uint8_t>& mask) {
    double sum = 0.0;
    double count = 0.0;
    for (size_t pixel = 0; pixel < mask.size(); ++pixel) {
        if (mask[pixel] == 0) continue;
        double mean = 0.0;
        double squares = 0.0;
        for (const auto& picture : pictures) {
            const double green = picture.rgba[pixel * 4 + 1];
            mean += green;
            squares += green * green;
        }
        mean /= static_cast<double>(pictures.size());
        squares /= static_cast<double>(pictures.size());
        sum += std::sqrt(std::max(squares - mean * mean, 0.0));
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

}  // namespace vellus::test
