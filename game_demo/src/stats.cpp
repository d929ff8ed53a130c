#include "game_demo/src/stats.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace vellus::demo {

namespace {

using Json = nlohmann::ordered_json;

Json pass_json(const graph::PassReport& pass) {
    return {{"name", pass.name},
            {"gpu_ms", pass.gpu_ms},
            {"cpu_ms", pass.cpu_ms},
            {"draws", pass.draws},
            {"dispatches", pass.dispatches}};
}

Json effect_json(const EffectRow& effect) {
    return {{"groom", effect.groom},
            {"axis", effect.axis},
            {"technique", effect.technique},
            {"reason", effect.reason}};
}

template <class Row, class ToJson>
Json list_json(const std::vector<Row>& rows, ToJson to_json) {
    Json list = Json::array();
    for (const Row& row : rows) list.push_back(to_json(row));
    return list;
}

Json frame_json(const FrameStats& frame) {
    const graph::MemoryReport& memory = frame.report.memory;
    return {{"index", frame.index},
            {"cpu_ms", frame.cpu_ms},
            {"wall_ms", frame.wall_ms},
            {"gpu_ms", frame.report.gpu_ms},
            {"unattributed_ms", frame.unattributed_ms()},
            {"passes", list_json(frame.report.passes, pass_json)},
            {"memory",
             {{"transient_bytes", memory.transient_bytes},
              {"transient_unaliased_bytes", memory.transient_unaliased_bytes},
              {"persistent_bytes", memory.persistent_bytes}}},
            {"effects", list_json(frame.effects, effect_json)}};
}

}  // namespace

double FrameStats::unattributed_ms() const {
    double rest = wall_ms;
    for (const graph::PassReport& pass : report.passes) rest -= pass.gpu_ms + pass.cpu_ms;
    return rest;
}

std::string to_json(const RunStats& stats) {
    const Json json = {
        {"version", 1},
        {"device",
         {{"name", stats.device.name}, {"driver", stats.device.driver}, {"api", stats.device.api}}},
        {"scene", stats.scene},
        {"seed", stats.seed},
        {"size", stats.size},
        {"hash", fmt::format("{:016x}", stats.hash)},
        {"frames", list_json(stats.frames, frame_json)}};
    // Names come from files: what is not UTF-8 is replaced, not thrown about.
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace vellus::demo
