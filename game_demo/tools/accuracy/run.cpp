#include "game_demo/tools/accuracy/run.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>

#include "engine/platform/log.h"
#include "engine/platform/user_folders.h"
#include "game_demo/src/progress.h"
#include "game_demo/tools/accuracy/measure.h"
#include "game_demo/tools/accuracy/merge.h"
#include "game_demo/tools/accuracy/report.h"

namespace vellus::demo {

namespace {

namespace fs = std::filesystem;

constexpr int kInterrupted = 130;

std::atomic<bool> stop_wished = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void wish_stop(int) {
    stop_wished = true;
}

std::string now_utc() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text.data();
}

Result<void> prepare_folder(const fs::path& folder) {
    std::error_code code;
    fs::create_directories(folder, code);
    if (fs::is_directory(folder, code) && ::access(folder.c_str(), W_OK) == 0) return {};
    return Error{"cannot write there", folder.string(), "give another folder with --out"};
}

void print_jobs(const std::vector<Job>& jobs) {
    for (const Job& job : jobs) fmt::print("{}\n", job.id());
}

/// Rows that are on file, of this run; the jobs that are not.
std::vector<Job> left_to_do(const Measure& measure, const std::vector<Job>& jobs,
                            std::vector<AccuracyRow>& rows) {
    std::vector<Job> left;
    for (const Job& job : jobs) {
        const fs::path file = measure.row_file(job);
        std::error_code code;
        auto row = fs::exists(file, code) ? load_accuracy_row(file) : Error{};
        if (row && measure.is_of_this_run(*row)) {
            rows.push_back(std::move(*row));
        } else {
            left.push_back(job);
        }
    }
    return left;
}

Result<void> measure_jobs(Measure& measure, const std::vector<Job>& jobs, size_t done,
                          std::vector<AccuracyRow>& rows) {
    const auto total = static_cast<uint32_t>(done + jobs.size());
    Progress progress(total, "jobs", static_cast<uint32_t>(done));
    for (const Job& job : jobs) {
        if (stop_wished) return {};
        auto row = measure.run(job);
        if (stop_wished && !row) return {};
        if (!row)
            return Error{row.error().what, job.id() + " " + row.error().where, row.error().remedy};
        rows.push_back(std::move(*row));
        progress.update(static_cast<uint32_t>(rows.size()));
    }
    return {};
}

std::string names(const std::vector<AxisChoice>& choices) {
    std::string result;
    for (const AxisChoice& choice : choices) {
        result.append(result.empty() ? "" : ", ").append(text(choice));
    }
    return result;
}

/// For each groom and colour measured: the choice, and what it turns out to be.
Result<void> spend_budget(Measure& measure, const AccuracyTable& table, double budget_ms) {
    std::vector<Subject> subjects;
    for (const AccuracyRow& row : table.rows) {
        if (row.axis != kFrameAxis) continue;
        const Subject subject{row.groom, row.colour, row.light};
        if (std::ranges::find(subjects, subject) == subjects.end()) subjects.push_back(subject);
    }
    if (subjects.empty()) {
        return Error{"no whole frame was measured", "--budget", "leave --axes out, or add frame"};
    }
    for (const Subject& subject : subjects) {
        const auto best = best_within(frame_model(table, subject.groom, subject.colour), budget_ms);
        if (!best || stop_wished) continue;
        auto measured = measure.run_combination(subject, best->choices);
        if (!measured) return measured.error();
        fmt::print("{} {}: {}\n", subject.groom, subject.colour, names(best->choices));
        fmt::print("    predicted {:.2f} ms, error {:.3f}; measured {:.2f} ms, error {:.3f}{}\n",
                   best->ms, best->error, measured->ms, measured->error,
                   best->ms > budget_ms ? "; nothing known is cheap enough" : "");
    }
    return {};
}

Result<void> measure_all(const AccuracyOptions& options) {
    if (auto ready = prepare_folder(options.out); !ready) return ready;
    auto device =
        gpu::Device::create({.name = options.device, .pipeline_cache_folder = cache_folder()});
    if (!device) return device.error();
    const JobSizes sizes = job_sizes(options);
    Measure measure(**device, options.out, sizes, stop_wished);
    AccuracyTable table{.device = (*device)->traits().name,
                        .driver = (*device)->traits().driver,
                        .command = options.command,
                        .date = now_utc(),
                        .seed = options.seed,
                        .size = sizes.size,
                        .rows = {}};
    const auto jobs = jobs_of_shard(all_jobs(options), options.shard);
    const auto left = left_to_do(measure, jobs, table.rows);
    if (!table.rows.empty())
        log_info("{} of {} jobs are done already", table.rows.size(), jobs.size());
    auto measured = measure_jobs(measure, left, table.rows.size(), table.rows);
    // What is there is kept, whatever ended the run.
    sort_rows(table);
    if (auto written = write_reports(options.out, table); !written) return written;
    if (!measured) return measured;
    if (stop_wished) {
        log_info("stopped: {} of {} jobs are done; the same command goes on", table.rows.size(),
                 jobs.size());
        return {};
    }
    log_info("{}/accuracy.html has {} rows", options.out.string(), table.rows.size());
    if (options.budget_ms) return spend_budget(measure, table, *options.budget_ms);
    return {};
}

}  // namespace

int run_accuracy(const AccuracyOptions& options) {
    if (options.list) {
        print_jobs(jobs_of_shard(all_jobs(options), options.shard));
        return 0;
    }
    std::signal(SIGINT, wish_stop);
    std::signal(SIGTERM, wish_stop);
    const auto done = options.merge.empty() ? measure_all(options) : merge(options);
    if (!done) {
        log_error("{}", done.error().message());
        return 1;
    }
    return stop_wished ? kInterrupted : 0;
}

}  // namespace vellus::demo
