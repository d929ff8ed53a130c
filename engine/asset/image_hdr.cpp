#include <charconv>
#include <cmath>
#include <string_view>

#include "engine/asset/image_detail.h"

// Radiance picture format: G. Ward, "Real Pixels", Graphics Gems II, and the Radiance file format
// manual.
namespace vellus::asset {
namespace {

using Rgbe = std::array<uint8_t, 4>;

struct Header {
    bool xyz = false;
    std::array<double, 3> exposure{1.0, 1.0, 1.0};
    uint32_t scanlines = 0;
    uint32_t scanline_pixels = 0;
    bool columns = false;
    bool flip_scanlines = false;
    bool flip_pixels = false;
};

Error broken(std::string what) {
    return {fmt::format("broken Radiance file: {}", std::move(what)), "", "export it again"};
}

/// The next line without its end; moves `text` past it. Nothing where no line end is left.
std::optional<std::string_view> next_line(std::string_view& text) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) {
        return std::nullopt;
    }
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (line.ends_with('\r')) {
        line.remove_suffix(1);
    }
    return line;
}

std::string_view next_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
}

template <class Number>
bool parse(std::string_view word, Number& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && end == word.data() + word.size();
}

/// EXPOSURE has one factor, COLORCORR three; each such line multiplies the pixels that follow.
bool apply_exposure(std::string_view words, bool per_channel, Header& header) {
    double factor = 1.0;
    for (size_t channel = 0; channel < 3; ++channel) {
        if (per_channel || channel == 0) {
            if (!parse(next_word(words), factor) || !(factor > 0.0) || !std::isfinite(factor)) {
                return false;
            }
        }
        header.exposure[channel] *= factor;
    }
    return true;
}

std::optional<Error> read_variables(std::string_view& text, Header& header) {
    while (true) {
        const auto line = next_line(text);
        if (!line) {
            return broken("the header has no end");
        }
        if (line->empty()) {
            return std::nullopt;
        }
        const size_t equals = line->find('=');
        if (equals == std::string_view::npos || line->starts_with('#')) {
            continue;
        }
        const std::string_view name = line->substr(0, equals);
        std::string_view value = line->substr(equals + 1);
        if (name == "FORMAT") {
            const std::string_view format = next_word(value);
            header.xyz = format == "32-bit_rle_xyze";
            if (!header.xyz && format != "32-bit_rle_rgbe") {
                return broken(fmt::format("unknown FORMAT '{}'", format));
            }
        } else if (name == "EXPOSURE" || name == "COLORCORR") {
            if (!apply_exposure(value, name == "COLORCORR", header)) {
                return broken(fmt::format("{} is no positive number", name));
            }
        }
    }
}

/// "-Y 512 +X 1024" and its seven turned and mirrored variants: the first axis counts scanlines.
std::optional<Error> read_resolution(std::string_view& text, Header& header) {
    const auto line = next_line(text);
    std::string_view words = line.value_or("");
    const std::string_view major = next_word(words);
    const bool major_ok = parse(next_word(words), header.scanlines);
    const std::string_view minor = next_word(words);
    const bool minor_ok = parse(next_word(words), header.scanline_pixels);
    header.columns = major == "+X" || major == "-X";
    const bool axes_ok = header.columns
                             ? (minor == "+Y" || minor == "-Y")
                             : (major == "+Y" || major == "-Y") && (minor == "+X" || minor == "-X");
    if (!major_ok || !minor_ok || !axes_ok) {
        return broken(fmt::format("resolution line '{}'", line.value_or("").substr(0, 40)));
    }
    header.flip_scanlines = major == "+Y" || major == "-X";
    header.flip_pixels = minor == "+Y" || minor == "-X";
    return std::nullopt;
}

class ScanlineReader {
  public:
    explicit ScanlineReader(std::string_view data) : data_(data) {}

    /// False where the data ends early or contradicts itself.
    bool read(std::vector<Rgbe>& scanline) {
        const size_t width = scanline.size();
        const bool run_length = width >= 8 && width < 32768 && data_.size() >= 4 && byte(0) == 2 &&
                                byte(1) == 2 && (size_t{byte(2)} << 8U | byte(3)) == width;
        return run_length ? read_channels(scanline) : read_pixels(scanline);
    }

  private:
    [[nodiscard]] uint8_t byte(size_t i) const { return static_cast<uint8_t>(data_[i]); }

    /// New run-length coding: the four channels one after the other.
    bool read_channels(std::vector<Rgbe>& scanline) {
        data_.remove_prefix(4);
        for (size_t channel = 0; channel < 4; ++channel) {
            for (size_t x = 0; x < scanline.size();) {
                if (data_.size() < 2) {
                    return false;
                }
                const bool run = byte(0) > 128;
                const size_t count = run ? byte(0) - 128U : byte(0);
                const size_t coded = run ? 1 : count;
                if (count == 0 || count > scanline.size() - x || data_.size() < 1 + coded) {
                    return false;
                }
                for (size_t i = 0; i < count; ++i) {
                    scanline[x + i][channel] = byte(run ? 1 : 1 + i);
                }
                data_.remove_prefix(1 + coded);
                x += count;
            }
        }
        return true;
    }

    /// Flat pixels; (1, 1, 1, n) repeats the last pixel n times, directly following such codes
    /// count in higher bytes.
    bool read_pixels(std::vector<Rgbe>& scanline) {
        unsigned shift = 0;
        for (size_t x = 0; x < scanline.size();) {
            if (data_.size() < 4) {
                return false;
            }
            const Rgbe pixel = {byte(0), byte(1), byte(2), byte(3)};
            data_.remove_prefix(4);
            if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
                const uint64_t count = shift < 32 ? uint64_t{pixel[3]} << shift : ~uint64_t{0};
                if (!last_ || count > scanline.size() - x) {
                    return false;
                }
                std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(x), count, *last_);
                x += count;
                shift += 8;
            } else {
                last_ = scanline[x++] = pixel;
                shift = 0;
            }
        }
        return true;
    }

    std::string_view data_;
    std::optional<Rgbe> last_;
};

/// XYZ to linear Rec. 709, D65 white (IEC 61966-2-1).
std::array<double, 3> rec709(const std::array<double, 3>& c) {
    return {3.2404542 * c[0] - 1.5371385 * c[1] - 0.4985314 * c[2],
            -0.9692660 * c[0] + 1.8760108 * c[1] + 0.0415560 * c[2],
            0.0556434 * c[0] - 0.2040259 * c[1] + 1.0572252 * c[2]};
}

void store(const Rgbe& pixel, const Header& header, float* rgba) {
    std::array<double, 3> color{};
    if (pixel[3] != 0) {
        for (size_t i = 0; i < 3; ++i) {
            color[i] =
                std::ldexp(static_cast<double>(pixel[i]), pixel[3] - 136) / header.exposure[i];
        }
    }
    if (header.xyz) {
        color = rec709(color);
    }
    for (size_t i = 0; i < 3; ++i) {
        rgba[i] = static_cast<float>(color[i]);
    }
    rgba[3] = 1.0f;
}

}  // namespace

Result<ImageF> decode_hdr(std::span<const std::byte> bytes) {
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!detail::is_hdr(bytes)) {
        return broken("it does not start with #?RADIANCE");
    }
    Header header;
    if (auto error = read_variables(text, header)) {
        return std::move(*error);
    }
    if (auto error = read_resolution(text, header)) {
        return std::move(*error);
    }
    const uint32_t width = header.columns ? header.scanlines : header.scanline_pixels;
    const uint32_t height = header.columns ? header.scanline_pixels : header.scanlines;
    if (auto error = detail::check_size(width, height, bytes.size())) {
        return std::move(*error);
    }
    ImageF image{width, height, std::vector<float>(size_t{4} * width * height), {}};
    ScanlineReader reader(text);
    std::vector<Rgbe> scanline(header.scanline_pixels);
    for (uint32_t s = 0; s < header.scanlines; ++s) {
        if (!reader.read(scanline)) {
            return broken(
                fmt::format("scanline {} of {} is cut off or wrong", s, header.scanlines));
        }
        const uint32_t major = header.flip_scanlines ? header.scanlines - 1 - s : s;
        for (uint32_t p = 0; p < header.scanline_pixels; ++p) {
            const uint32_t minor = header.flip_pixels ? header.scanline_pixels - 1 - p : p;
            const size_t x = header.columns ? major : minor;
            const size_t y = header.columns ? minor : major;
            store(scanline[p], header, image.rgba.data() + 4 * (y * width + x));
        }
    }
    detail::repair_pixels(image);
    return image;
}

}  // namespace vellus::asset
