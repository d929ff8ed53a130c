#include "game_demo/tools/accuracy/merge.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "engine/platform/files.h"
#include "engine/platform/log.h"
#include "game_demo/tools/accuracy/report.h"

namespace vellus::demo {

namespace {

namespace fs = std::filesystem;

Result<void> copy_results(const fs::path& from, const fs::path& to) {
    for (const char* folder : {"jobs", "references"}) {
        std::error_code code;
        if (!fs::is_directory(from / folder, code)) continue;
        fs::create_directories(to / folder, code);
        fs::copy(from / folder, to / folder, fs::copy_options::overwrite_existing, code);
        if (code) {
            return Error{"cannot copy to " + (to / folder).string() + ": " + code.message(),
                         (from / folder).string(), "make room, or give another folder with --out"};
        }
    }
    return {};
}

}  // namespace

void sort_rows(AccuracyTable& table) {
    const auto key = [](const AccuracyRow& row) {
        return std::tie(row.axis, row.technique, row.setting, row.groom, row.colour, row.light,
                        row.device);
    };
    std::ranges::stable_sort(table.rows,
                             [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto same = [](const AccuracyRow& a, const AccuracyRow& b) {
        return a.id == b.id && a.device == b.device;
    };
    const auto rest = std::ranges::unique(table.rows, same);
    table.rows.erase(rest.begin(), rest.end());
}

AccuracyTable join(std::vector<AccuracyTable> tables) {
    AccuracyTable all = std::move(tables.at(0));
    for (size_t i = 1; i < tables.size(); ++i) {
        if (all.device.find(tables[i].device) == std::string::npos) {
            all.device += ", " + tables[i].device;
            all.driver += ", " + tables[i].driver;
        }
        std::ranges::move(tables[i].rows, std::back_inserter(all.rows));
    }
    sort_rows(all);
    return all;
}

Result<void> merge(const AccuracyOptions& options) {
    std::vector<AccuracyTable> tables;
    for (const fs::path& folder : options.merge) {
        auto table = load_accuracy(folder / "accuracy.json");
        if (!table) return table.error();
        tables.push_back(std::move(*table));
        if (auto copied = copy_results(folder, options.out); !copied) return copied;
    }
    const AccuracyTable all = join(std::move(tables));
    if (auto written = write_reports(options.out, all); !written) return written;
    log_info("{}/accuracy.html has {} rows", options.out.string(), all.rows.size());
    return {};
}

}  // namespace vellus::demo
