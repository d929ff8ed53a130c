#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/fuzz/fuzz.h"

// The run without libFuzzer: mutates the seeds with a fixed random sequence, so that every machine
// sees the same inputs.
namespace {

using vellus::fuzz::Bytes;

volatile std::sig_atomic_t g_iteration = -1;

/// splitmix64: the same numbers with every standard library.
class Random {
  public:
    explicit Random(uint64_t seed) : state_(seed) {}
    uint64_t next() {
        state_ += 0x9e3779b97f4a7c15U;
        uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }
    size_t below(size_t n) { return n == 0 ? 0 : static_cast<size_t>(next() % n); }

  private:
    uint64_t state_;
};

bool is_digit(uint8_t c) {
    return c >= '0' && c <= '9';
}

/// Replaces one decimal number of a text by one that tends to break readers.
void replace_number(Bytes& bytes, Random& random) {
    static const std::array<const char*, 12> kNumbers = {
        "0",          "-1",         "1",    "2",   "255", "65535",
        "2147483647", "4294967295", "1e39", "0.5", "-0",  "9007199254740993"};
    const size_t start = random.below(bytes.size());
    const auto first =
        std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(start), bytes.end(), is_digit);
    const auto last = std::find_if_not(first, bytes.end(), is_digit);
    const std::string text = kNumbers[random.below(kNumbers.size())];
    const auto at = bytes.erase(first, last);
    bytes.insert(at, text.begin(), text.end());
}

void overwrite(Bytes& bytes, Random& random) {
    static const std::array<uint8_t, 8> kValues = {0x00, 0xff, 0x7f, 0x80, 0x01, 0x20, 0x40, 0xfe};
    const size_t start = random.below(bytes.size());
    const size_t count = std::min(bytes.size() - start, size_t{1} << random.below(4));
    const uint8_t value = kValues[random.below(kValues.size())];
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(start), count, value);
}

void erase(Bytes& bytes, Random& random) {
    const size_t start = random.below(bytes.size());
    const size_t count = std::min(bytes.size() - start, 1 + random.below(16));
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(start);
    bytes.erase(first, first + static_cast<std::ptrdiff_t>(count));
}

/// Copies a piece of `other` (or of itself) to a random place.
void splice(Bytes& bytes, const Bytes& other, Random& random) {
    const size_t from = random.below(other.size());
    const size_t count = std::min(other.size() - from, 1 + random.below(64));
    const Bytes piece(other.begin() + static_cast<std::ptrdiff_t>(from),
                      other.begin() + static_cast<std::ptrdiff_t>(from + count));
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(random.below(bytes.size())),
                 piece.begin(), piece.end());
}

Bytes mutate(const std::vector<Bytes>& seeds, Random& random) {
    Bytes bytes = seeds[random.below(seeds.size())];
    const size_t changes = 1 + random.below(6);
    for (size_t i = 0; i < changes && !bytes.empty(); ++i) {
        switch (random.below(7)) {
            case 0:
                bytes[random.below(bytes.size())] ^= static_cast<uint8_t>(1U << random.below(8));
                break;
            case 1:
                bytes[random.below(bytes.size())] = static_cast<uint8_t>(random.next());
                break;
            case 2:
                overwrite(bytes, random);
                break;
            case 3:
                erase(bytes, random);
                break;
            case 4:
                splice(bytes, seeds[random.below(seeds.size())], random);
                break;
            case 5:
                replace_number(bytes, random);
                break;
            default:
                if (random.below(4) == 0) {
                    bytes.resize(random.below(bytes.size()));
                }
        }
    }
    return bytes;
}

void report_crash(int signal) {
    std::fprintf(stderr, "fuzz: signal %d in iteration %d\n", signal,
                 static_cast<int>(g_iteration));
    std::_Exit(1);
}

}  // namespace

/// driver [ITERATIONS [ONLY]]: with ONLY, runs just that iteration and keeps its input in
/// fuzz_input.bin.
int main(int argc, char** argv) {
    int iterations = 3000;
    int only = -1;
    const std::string first = argc > 1 ? argv[1] : "";
    const std::string second = argc > 2 ? argv[2] : "";
    std::from_chars(first.data(), first.data() + first.size(), iterations);
    std::from_chars(second.data(), second.data() + second.size(), only);
    for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGILL}) {
        std::signal(signal, report_crash);
    }
    const std::vector<Bytes> seeds = vellus::fuzz::all_seeds();
    if (seeds.empty()) {
        std::fprintf(stderr, "fuzz: this target has no seeds\n");
        return 1;
    }
    for (const Bytes& seed : seeds) {
        LLVMFuzzerTestOneInput(seed.data(), seed.size());
    }
    for (int i = 0; i < iterations; ++i) {
        g_iteration = i;
        if (only >= 0 && i != only) {
            continue;
        }
        Random random(static_cast<uint64_t>(i));
        const Bytes input = mutate(seeds, random);
        if (i == only) {
            std::ofstream("fuzz_input.bin", std::ios::binary)
                .write(reinterpret_cast<const char*>(input.data()),
                       static_cast<std::streamsize>(input.size()));
        }
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
    std::printf("fuzz: %zu seeds, %d mutations, no crash\n", seeds.size(), iterations);
    return 0;
}
