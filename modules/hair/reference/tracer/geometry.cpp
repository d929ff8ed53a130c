#include "modules/hair/reference/tracer/geometry.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "modules/hair/reference/tracer/random.h"

namespace vellus::hair::tracer {

namespace {

double share_of(uint64_t seed, uint64_t what) {
    return static_cast<double>(mix_bits(seed ^ mix_bits(what + 1)) >> 11U) * 0x1p-53;
}

glm::vec4 sample_texture(const asset::ImageF& image, const glm::vec2& uv) {
    const glm::vec2 at = (uv - glm::floor(uv)) * glm::vec2(image.width, image.height) - 0.5f;
    const glm::vec2 corner = glm::floor(at);
    const glm::vec2 f = at - corner;
    const auto texel = [&](int64_t x, int64_t y) {
        x = (x + image.width) % image.width;
        y = (y + image.height) % image.height;
        const float* c = image.rgba.data() + 4 * (y * image.width + x);
        return glm::vec4(c[0], c[1], c[2], c[3]);
    };
    const auto x = static_cast<int64_t>(corner.x);
    const auto y = static_cast<int64_t>(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x), f.y);
}

}  // namespace

glm::vec4 mesh_color(const Scene& scene, const Mesh& mesh, uint32_t triangle,
                     const glm::dvec2& at) {
    const glm::uvec3 v = mesh.triangles[triangle];
    const glm::vec3 w(1.0 - at.x - at.y, at.x, at.y);
    glm::vec4 color = mesh.base_color;
    if (!mesh.colors.empty()) {
        color *= mesh.colors[v.x] * w.x + mesh.colors[v.y] * w.y + mesh.colors[v.z] * w.z;
    }
    if (mesh.texture != kNone) {
        const glm::vec2 uv =
            mesh.texcoords.empty()
                ? glm::vec2(0.0f)
                : mesh.texcoords[v.x] * w.x + mesh.texcoords[v.y] * w.y + mesh.texcoords[v.z] * w.z;
        color *= sample_texture(scene.textures[mesh.texture], uv);
    }
    return color;
}

/// Embree's handles; geometry ids: grooms first, then meshes.
struct Geometry::Embree {
    const Scene* scene = nullptr;
    RTCDevice device = nullptr;
    RTCScene handle = nullptr;
    std::vector<std::vector<uint8_t>> flags;  // by groom: which segments have neighbours

    ~Embree() {
        if (handle) rtcReleaseScene(handle);
        if (device) rtcReleaseDevice(device);
    }
    [[nodiscard]] bool is_groom(uint32_t id) const { return id < scene->grooms.size(); }
    void add_groom(const Groom& groom);
    void add_mesh(const Mesh& mesh);
};

namespace {

/// What the filter knows of the ray; Embree hands the first member back.
struct FilterContext {
    RTCIntersectContext base{};
    const Scene* scene = nullptr;
    const Ray* ray = nullptr;
};

bool strand_stops(const Groom& groom, uint32_t id, uint32_t segment, const Ray& ray, double t) {
    if (ray.ignores_hair) return false;
    const uint32_t strand = groom.segment_strand[segment];
    if (id == ray.own.groom && strand == ray.own.strand && t < ray.own.until) return false;
    return groom.alpha >= 1.0f || share_of(ray.seed, (uint64_t{id} << 32U) | strand) < groom.alpha;
}

bool mesh_stops(const Scene& scene, const Mesh& mesh, uint32_t triangle, const glm::dvec2& at,
                bool from_behind, const Ray& ray) {
    if (ray.from_camera && !mesh.two_sided && from_behind != mesh.mirrored) return false;
    if (mesh.alpha_cutoff == 0.0f) return true;
    const float alpha = mesh_color(scene, mesh, triangle, at).a;
    if (mesh.alpha_cutoff > 0.0f) return alpha >= mesh.alpha_cutoff;
    return share_of(ray.seed, (uint64_t{1} << 63U) | triangle) < alpha;
}

/// Refuses hits that the ray passes.
void filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const unsigned n = arguments->N;
        const uint32_t id = RTCHitN_geomID(arguments->hit, n, i);
        const uint32_t primitive = RTCHitN_primID(arguments->hit, n, i);
        const glm::dvec3 normal(RTCHitN_Ng_x(arguments->hit, n, i),
                                RTCHitN_Ng_y(arguments->hit, n, i),
                                RTCHitN_Ng_z(arguments->hit, n, i));
        const glm::dvec2 at(RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i));
        const bool from_behind = glm::dot(normal, context.ray->direction) > 0.0;
        bool stops = false;
        if (id < context.scene->grooms.size()) {
            // A strand is entered through its front; its back only ends the way through it.
            stops = !from_behind && strand_stops(context.scene->grooms[id], id, primitive,
                                                 *context.ray, RTCRayN_tfar(arguments->ray, n, i));
        } else {
            const Mesh& mesh = context.scene->meshes[id - context.scene->grooms.size()];
            stops = mesh_stops(*context.scene, mesh, primitive, at, from_behind, *context.ray);
        }
        if (!stops) arguments->valid[i] = 0;
    }
}

RTCRay to_embree(const Ray& ray, double far) {
    RTCRay r{};
    r.org_x = static_cast<float>(ray.origin.x);
    r.org_y = static_cast<float>(ray.origin.y);
    r.org_z = static_cast<float>(ray.origin.z);
    r.dir_x = static_cast<float>(ray.direction.x);
    r.dir_y = static_cast<float>(ray.direction.y);
    r.dir_z = static_cast<float>(ray.direction.z);
    r.tnear = static_cast<float>(ray.near);
    r.tfar = static_cast<float>(far);
    r.mask = ~0u;
    return r;
}

FilterContext context_of(const Scene& scene, const Ray& ray) {
    FilterContext context;
    rtcInitIntersectContext(&context.base);
    context.base.filter = filter;
    context.scene = &scene;
    context.ray = &ray;
    return context;
}

}  // namespace

void Geometry::Embree::add_groom(const Groom& groom) {
    // A segment whose end is the next one's start goes on there; only then do they join cleanly.
    std::vector<uint8_t>& joined = flags.emplace_back(groom.segment_point.size(), uint8_t{0});
    for (size_t i = 1; i < joined.size(); ++i) {
        if (groom.segment_strand[i] != groom.segment_strand[i - 1]) continue;
        joined[i - 1] |= RTC_CURVE_FLAG_NEIGHBOR_RIGHT;
        joined[i] |= RTC_CURVE_FLAG_NEIGHBOR_LEFT;
    }
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               groom.points.data(), 0, sizeof(glm::vec4), groom.points.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                               groom.segment_point.data(), 0, sizeof(uint32_t),
                               groom.segment_point.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, joined.data(),
                               0, 1, joined.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handle, geometry);
    rtcReleaseGeometry(geometry);
}

void Geometry::Embree::add_mesh(const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 16 bytes of the last vertex, so it gets its own copy.
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), mesh.positions.size());
    if (vertices != nullptr) {
        std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(vertices));
    }
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles.data(), 0, sizeof(glm::uvec3), mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handle, geometry);
    rtcReleaseGeometry(geometry);
}

Geometry::Geometry(std::unique_ptr<Embree> embree) : embree_(std::move(embree)) {}
Geometry::~Geometry() = default;

Result<std::unique_ptr<Geometry>> Geometry::build(const Scene& scene) {
    auto embree = std::make_unique<Embree>();
    embree->scene = &scene;
    embree->device = rtcNewDevice(nullptr);
    if (embree->device == nullptr) {
        return Error{"Embree does not start", "path tracer", "check that libembree3 is installed"};
    }
    embree->handle = rtcNewScene(embree->device);
    rtcSetSceneFlags(
        embree->handle,
        static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    for (const Groom& groom : scene.grooms) embree->add_groom(groom);
    for (const Mesh& mesh : scene.meshes) embree->add_mesh(mesh);
    rtcCommitScene(embree->handle);
    if (const RTCError code = rtcGetDeviceError(embree->device); code != RTC_ERROR_NONE) {
        return Error{fmt::format("Embree reports error {}", static_cast<int>(code)), "path tracer",
                     code == RTC_ERROR_OUT_OF_MEMORY ? "use a smaller scene" : "report this scene"};
    }
    return std::unique_ptr<Geometry>(new Geometry(std::move(embree)));
}

bool Geometry::closest(const Ray& ray, Hit& hit) const {
    FilterContext context = context_of(*embree_->scene, ray);
    RTCRayHit found{};
    found.ray = to_embree(ray, std::numeric_limits<double>::infinity());
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->handle, &context.base, &found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const uint32_t id = found.hit.geomID;
    const bool groom = embree_->is_groom(id);
    const glm::dvec3 normal(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z);
    hit.distance = found.ray.tfar;
    hit.groom = groom ? id : kNone;
    hit.mesh = groom ? kNone : id - static_cast<uint32_t>(embree_->scene->grooms.size());
    hit.primitive = found.hit.primID;
    hit.at = {found.hit.u, found.hit.v};
    const double length = glm::length(normal);
    hit.normal = length > 0.0 ? normal / length : -ray.direction;
    return true;
}

bool Geometry::blocked(const Ray& ray, double distance) const {
    FilterContext context = context_of(*embree_->scene, ray);
    RTCRay embree_ray = to_embree(ray, distance);
    rtcOccluded1(embree_->handle, &context.base, &embree_ray);
    return embree_ray.tfar < 0.0f;
}

}  // namespace vellus::hair::tracer
