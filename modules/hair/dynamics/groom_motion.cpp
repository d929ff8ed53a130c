#include "modules/hair/dynamics/groom_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "engine/platform/jobs.h"
#include "modules/hair/binding/components.h"
#include "modules/hair/dynamics/card_rows.h"

namespace vellus::hair {

namespace {

// Less than this, a hundredth of a millimetre at the end of 10 cm, counts as unbent.
constexpr float kUnbent = 1e-4f;

/// Strands, or the middle lines of cards, in columns.
struct Lines {
    std::vector<glm::vec3> points;
    std::vector<uint32_t> begin;
};

Lines lines_of(const LibraryGroom& groom, const CardRows& rows) {
    if (!groom.cards) return {groom.positions, groom.strand_begin};
    Lines lines{{}, rows.card_begin};
    for (uint32_t card = 0; card + 1 < rows.card_begin.size(); ++card) {
        const auto line = rows.line(groom.positions, card);
        lines.points.insert(lines.points.end(), line.begin(), line.end());
    }
    return lines;
}

/// A guide's points where it is at rest: in its root's frame where bound, else as loaded.
std::vector<glm::vec3> rest_points(const LibraryGroom& groom, const CardRows& rows,
                                   const BoundRoots* bound, uint32_t strand) {
    const auto& points = bound != nullptr ? bound->local : groom.positions;
    if (groom.cards) return rows.line(points, strand);
    return {points.begin() + groom.strand_begin[strand],
            points.begin() + groom.strand_begin[strand + 1]};
}

/// The rotation of a map without shear; of one with, a near one.
glm::dquat rotation_of(const glm::dmat3& m) {
    const glm::dvec3 x = glm::normalize(m[0]);
    const glm::dvec3 y = glm::normalize(m[1] - x * glm::dot(x, m[1]));
    return glm::normalize(glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y))));
}

template <class T>
Result<void> upload(gpu::Device& device, std::span<const T> values, const char* name,
                    gpu::Buffer& out) {
    auto made = gpu::Buffer::upload_span(device, values, name);
    if (!made) return made.error();
    out = *std::move(made);
    return {};
}

Result<void> upload_rows(gpu::Device& device, const CardRows& rows, MotionBuffers& out) {
    out.row_edge = rows.edge;
    if (auto done = upload(device, std::span<const uint32_t>(rows.row_begin), "hair card rows",
                           out.row_begin);
        !done) {
        return done;
    }
    return upload(device, std::span<const uint32_t>(rows.points), "hair card row points",
                  out.row_points);
}

Result<std::unique_ptr<MotionBuffers>> make_buffers(gpu::Device& device,
                                                    std::span<const uint32_t> begin,
                                                    const CardRows& rows,
                                                    const GroomMotion& groom) {
    auto made = std::make_unique<MotionBuffers>();
    if (auto done = upload(device, std::span<const StrandGuides>(groom.follow),
                           "hair strand guides", made->follow);
        !done) {
        return done.error();
    }
    if (auto done = upload(device, begin, "hair strand begins", made->strand_begin); !done) {
        return done.error();
    }
    auto turns = gpu::Buffer::create(device, kTurnSlots * groom.turn_bytes(),
                                     gpu::MemoryKind::kUpload, "hair guide turns");
    if (!turns) return turns.error();
    made->turns = *std::move(turns);
    if (rows.edge != 0) {
        if (auto done = upload_rows(device, rows, *made); !done) return done.error();
    }
    return made;
}

const BoundRoots* bound_roots(const World& world, const HairBinding* binding) {
    if (binding == nullptr) return nullptr;
    return &world.resource<HairBindings>().list[binding->roots].roots;
}

/// Guides of a groom, at rest, and who follows them.
std::unique_ptr<GroomMotion> choose_guides(const LibraryGroom& groom, const BoundRoots* bound,
                                           const CardRows& rows, const Lines& all,
                                           uint32_t guides) {
    const size_t strands = all.begin.empty() ? 0 : all.begin.size() - 1;
    const uint32_t count = guides == 0 ? default_guide_count(strands) : guides;
    GuideSelection chosen = select_guides(all.points, all.begin, count);
    std::vector<std::vector<glm::vec3>> lines;
    lines.reserve(chosen.guides.size());
    for (const uint32_t strand : chosen.guides) {
        lines.push_back(rest_points(groom, rows, bound, strand));
    }
    auto made = std::make_unique<GroomMotion>(make_guides(lines));
    made->strands = std::move(chosen.guides);
    made->follow = std::move(chosen.follow);
    made->spread = chosen.spread + rows.half_width;
    made->roots.resize(made->strands.size());
    return made;
}

const LibraryGroom& groom_of(const World& world, Entity hair) {
    const Hair* const worn = world.get<Hair>(hair);
    assert(worn != nullptr);
    return world.resource<HairLibrary>().grooms[worn->groom];
}

void wear(World& world, Entity hair, HairMotion motion, std::unique_ptr<GroomMotion> made) {
    remove_motion(world, hair);
    auto& list = world.resource<HairMotions>().list;
    motion.slot = static_cast<uint32_t>(list.size());
    made->entity = hair;
    list.push_back(std::move(made));
    world.add(hair, motion);
    world.add(hair, HairMoves{});
}

}  // namespace

Result<void> add_motion(World& world, gpu::Device& device, Entity hair, const HairMotion& motion,
                        uint32_t guides) {
    const LibraryGroom& groom = groom_of(world, hair);
    const CardRows rows = groom.cards ? cut_rows(groom) : CardRows{};
    const Lines all = lines_of(groom, rows);
    auto made =
        choose_guides(groom, bound_roots(world, world.get<HairBinding>(hair)), rows, all, guides);
    auto buffers = make_buffers(device, all.begin, rows, *made);
    if (!buffers) return buffers.error();
    made->buffers = *std::move(buffers);
    made->follow = {};
    wear(world, hair, motion, std::move(made));
    return {};
}

void add_motion(World& world, Entity hair, HairMotion motion, uint32_t guides) {
    const LibraryGroom& groom = groom_of(world, hair);
    auto made = choose_guides(groom, bound_roots(world, world.get<HairBinding>(hair)), {},
                              lines_of(groom, {}), guides);
    motion.solver = MotionSolver::kProcessor;
    wear(world, hair, motion, std::move(made));
}

bool remove_motion(World& world, Entity hair) {
    const HairMotion* const motion = world.get<HairMotion>(hair);
    if (motion == nullptr) return false;
    auto& list = world.resource<HairMotions>().list;
    if (motion->slot < list.size()) list[motion->slot]->entity = kNoEntity;
    world.remove<HairMotion>(hair);
    world.remove<HairMoves>(hair);
    return true;
}

bool place_roots(const BoundRoots* bound, const HairPose* pose, const glm::dmat4& world,
                 GroomMotion& out, double& scale) {
    const GuideSet& guides = out.motion.guides();
    if (bound != nullptr && pose != nullptr) {
        if (pose->handedness < 0.0f) return false;
        scale = static_cast<double>(pose->scale[0]);
        parallel_ranges(guides.count, 64, [&](size_t first, size_t last) {
            for (size_t g = first; g < last; ++g) {
                const RootFrame frame = root_frame(*bound, *pose, out.strands[g], PoseOf::kNow);
                out.roots[g] = {frame.position + frame.axes * glm::dvec3(guides.root[g]),
                                rotation_of(frame.axes)};
            }
        });
        return scale > 0.0;
    }
    const glm::dmat3 axes(world);
    const double volume = glm::determinant(axes);
    if (volume <= 0.0) return false;
    scale = std::cbrt(volume);
    const glm::dquat turn = rotation_of(axes);
    for (uint32_t g = 0; g < guides.count; ++g) {
        out.roots[g] = {glm::dvec3(world * glm::dvec4(glm::dvec3(guides.root[g]), 1.0)), turn};
    }
    return true;
}

void write_turns(GroomMotion& groom) {
    const GuideSet& guides = groom.motion.guides();
    groom.slot = (groom.slot + 1) % kTurnSlots;
    uint64_t* const out = groom.buffers
                              ? reinterpret_cast<uint64_t*>(groom.buffers->turns.mapped() +
                                                            groom.slot * groom.turn_bytes())
                              : nullptr;
    float most = 0.0f;
    for (uint32_t g = 0; g < guides.count; ++g) {
        visit_link_turns(groom, g, [&](uint32_t link, const glm::quat& turn) {
            most = std::max({most, std::abs(turn.x), std::abs(turn.y), std::abs(turn.z)});
            if (out == nullptr) return;
            out[size_t{g} * guides.links + link] =
                glm::packSnorm4x16(glm::vec4(turn.x, turn.y, turn.z, turn.w));
        });
    }
    groom.bent = most > kUnbent;
}

}  // namespace vellus::hair
