// Decides how a column of the ECS lies in memory: one block that doubles by copying, one block that
// grows by remapping (resize_memory), or chunks that never move.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "engine/ecs/growing_array.h"
#include "tests/perf/bench.h"
#include "tests/perf/ecs_baseline.h"
#include "tests/perf/ecs_cases.h"

namespace vellus::bench {
namespace {

struct Copied {
    std::vector<Position> rows;
    void push(const Position& position) { rows.push_back(position); }
    Position& at(size_t i) { return rows[i]; }
    template <class Visit>
    void each(const Visit& visit) {
        for (Position& position : rows) visit(position);
    }
};

struct Remapped {
    GrowingArray<Position> rows;
    void push(const Position& position) { rows[rows.append(1)] = position; }
    Position& at(size_t i) { return rows[i]; }
    template <class Visit>
    void each(const Visit& visit) {
        Position* const data = &rows[0];
        for (size_t i = 0, size = rows.size(); i < size; ++i) visit(data[i]);
    }
};

template <size_t kRows>
struct Chunked {
    std::vector<std::unique_ptr<Position[]>> chunks;
    size_t size = 0;
    void push(const Position& position) {
        if (size % kRows == 0) chunks.push_back(std::make_unique_for_overwrite<Position[]>(kRows));
        at(size++) = position;
    }
    Position& at(size_t i) { return chunks[i / kRows][i % kRows]; }
    template <class Visit>
    void each(const Visit& visit) {
        for (size_t first = 0; first < size; first += kRows) {
            Position* const data = chunks[first / kRows].get();
            for (size_t i = 0, end = std::min(kRows, size - first); i < end; ++i) visit(data[i]);
        }
    }
};

struct LayoutTimes {
    double push = 1e9;
    double iterate = 1e9;
    double random = 1e9;
    bool verified = true;
};

template <class Layout>
void measure(LayoutTimes& best, const std::vector<uint32_t>& order) {
    const size_t count = order.size();
    const double nanoseconds = 1e9 / static_cast<double>(count);
    Layout layout;
    best.push = std::min(best.push, nanoseconds * seconds_of([&] {
                                        for (size_t i = 0; i < count; ++i)
                                            layout.push({static_cast<float>(i), 0, 0});
                                    }));
    best.iterate =
        std::min(best.iterate,
                 nanoseconds * seconds_of([&] { layout.each([](Position& p) { p.y += 1; }); }));
    best.random = std::min(best.random, nanoseconds * seconds_of([&] {
                                            for (const uint32_t i : order) layout.at(i).z += 1;
                                        }));
    for (size_t i = 0; i < count; ++i) {
        const Position& p = layout.at(i);
        best.verified &= p.x == static_cast<float>(i) && p.y == 1 && p.z == 1;
    }
}

struct LayoutOptions {
    size_t count = 4'000'000;
    int rounds = 7;
};

int run_layouts(const LayoutOptions& options) {
    std::vector<uint32_t> order(options.count);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), std::mt19937_64(3));
    LayoutTimes copied;
    LayoutTimes remapped;
    LayoutTimes small;
    LayoutTimes large;
    for (int round = 0; round < options.rounds; ++round) {
        measure<Copied>(copied, order);
        measure<Remapped>(remapped, order);
        measure<Chunked<1024>>(small, order);
        measure<Chunked<65536>>(large, order);
    }
    fmt::print("{:<36} {:>8} {:>8} {:>8}\n", fmt::format("ns per row, {} rows", options.count),
               "push", "iterate", "random");
    bool verified = true;
    const auto print = [&](const char* name, const LayoutTimes& times) {
        fmt::print("{:<36} {:>8.2f} {:>8.2f} {:>8.2f}{}\n", name, times.push, times.iterate,
                   times.random, times.verified ? "" : "  WRONG RESULT");
        verified &= times.verified;
    };
    print("one block, doubled by copying", copied);
    print("one block, doubled by remapping", remapped);
    print("chunks of 1,024 rows", small);
    print("chunks of 65,536 rows", large);
    return verified ? 0 : 1;
}

const Registration kLayout(
    {"ecs-layout", "Columns of the ECS: one block or chunks",
     [](CLI::App& app) -> std::function<int()> {
         const auto options = std::make_shared<LayoutOptions>();
         app.add_option("--count", options->count, "Rows")->check(CLI::Range(1, 100'000'000));
         app.add_option("--rounds", options->rounds, "Turns per layout")
             ->check(CLI::Range(1, 1000));
         return [options] { return run_layouts(*options); };
     }});

}  // namespace
}  // namespace vellus::bench
