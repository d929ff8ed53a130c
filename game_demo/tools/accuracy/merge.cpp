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
        fs::create_directories(to / folder, code);
        for (const auto& entry : fs::directory_iterator(from / folder, code)) {
            fs::copy_file(entry.path(), to / folder / entry.path().filename(),
                          fs::copy_options::overwrite_existing, code);
            if (!code) continue;
            return Error{"cannot be copied: " + code.message(), entry.path().string(),
                         "make room, or give another folder with --out"};
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
    table.rows.erase(std::unique(table.rows.begin(), table.rows.end(), same), table.rows.end());
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
