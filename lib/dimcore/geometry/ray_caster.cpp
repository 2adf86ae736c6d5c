#include "geometry/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"

namespace dim {
namespace {

// What one hit test needs, in one place: the plane, the two axes and their offsets.
struct PlateData {
  Vec3 n{0.0};
  Vec3 u{0.0};
  Vec3 v{0.0};
  double n0 = 0.0, u0 = 0.0, v0 = 0.0;  // dot products of the axes with the frame's origin
  Vec2 size_m{0.0};
  const Polygon* polygon = nullptr;
  bool rectangle = false;
  bool open_back = false;
};

// Embree hands this back to the callbacks; its first member must be Embree's own context.
struct Query {
  RTCIntersectContext context;
  Vec3 origin;
  Vec3 direction;
  double t_min;
  double t_max;
  unsigned skip;
  Hit hit;
};

float round_up(double t) {
  return std::nextafter(static_cast<float>(t) * (1.0F + 1e-6F), std::numeric_limits<float>::infinity());
}

}  // namespace

struct RayCaster::Scene {
  std::vector<PlateData> plates;
  double tolerance_m = 0.0;
  float pad_m = 0.0F;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  bool test(const PlateData& plate, const Query& query, Hit& hit) const {
    const double approach = glm::dot(plate.n, query.direction);
    if (approach == 0.0) return false;
    const bool back = approach > 0.0;
    if (back && plate.open_back) return false;
    const double t = (plate.n0 - glm::dot(plate.n, query.origin)) / approach;
    if (!(t > query.t_min) || t > query.t_max) return false;
    const Vec2 local(glm::dot(plate.u, query.origin) - plate.u0 + t * glm::dot(plate.u, query.direction),
                     glm::dot(plate.v, query.origin) - plate.v0 + t * glm::dot(plate.v, query.direction));
    if (local.x < -tolerance_m || local.y < -tolerance_m || local.x > plate.size_m.x + tolerance_m ||
        local.y > plate.size_m.y + tolerance_m)
      return false;
    if (!plate.rectangle && !plate.polygon->contains(local, tolerance_m)) return false;
    hit.back = back;
    hit.t = t;
    hit.local = local;
    return true;
  }

  static void bounds(const RTCBoundsFunctionArguments* args);
  static void intersect(const RTCIntersectFunctionNArguments* args);
  static void occluded(const RTCOccludedFunctionNArguments* args);
};

void RayCaster::Scene::bounds(const RTCBoundsFunctionArguments* args) {
  const auto& self = *static_cast<const Scene*>(args->geometryUserPtr);
  const auto& polygon = *self.plates[args->primID].polygon;
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& ring : polygon.rings()) {
    for (const auto& p : ring) {
      low = glm::min(low, polygon.frame().to_world(p));
      high = glm::max(high, polygon.frame().to_world(p));
    }
  }
  auto& box = *args->bounds_o;
  box.lower_x = static_cast<float>(low.x) - self.pad_m;
  box.lower_y = static_cast<float>(low.y) - self.pad_m;
  box.lower_z = static_cast<float>(low.z) - self.pad_m;
  box.upper_x = static_cast<float>(high.x) + self.pad_m;
  box.upper_y = static_cast<float>(high.y) + self.pad_m;
  box.upper_z = static_cast<float>(high.z) + self.pad_m;
}

void RayCaster::Scene::intersect(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto& self = *static_cast<const Scene*>(args->geometryUserPtr);
  auto& query = *reinterpret_cast<Query*>(args->context);
  if (args->primID == query.skip) return;
  Hit hit;
  if (!self.test(self.plates[args->primID], query, hit)) return;
  const int plate = static_cast<int>(args->primID);
  // The order in which boxes are visited is Embree's business; the answer must not depend on it.
  if (query.hit.plate >= 0 && hit.t == query.hit.t && plate > query.hit.plate) return;
  hit.plate = plate;
  query.hit = hit;
  query.t_max = hit.t;
  reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = round_up(hit.t);
}

void RayCaster::Scene::occluded(const RTCOccludedFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto& self = *static_cast<const Scene*>(args->geometryUserPtr);
  auto& query = *reinterpret_cast<Query*>(args->context);
  if (args->primID == query.skip) return;
  Hit hit;
  if (!self.test(self.plates[args->primID], query, hit)) return;
  query.hit.plate = static_cast<int>(args->primID);
  reinterpret_cast<RTCRay*>(args->ray)->tfar = -std::numeric_limits<float>::infinity();
}

RayCaster::RayCaster(std::vector<Plate> plates, double diameter_m) : scene_(std::make_unique<Scene>()) {
  scene_->tolerance_m = 1e-9 * diameter_m;
  scene_->pad_m = static_cast<float>(4e-6 * diameter_m);
  for (const auto& plate : plates) {
    const auto& frame = plate.polygon->frame();
    scene_->plates.push_back({frame.n, frame.u, frame.v, glm::dot(frame.n, frame.origin),
                              glm::dot(frame.u, frame.origin), glm::dot(frame.v, frame.origin),
                              plate.polygon->size_m(), plate.polygon,
                              plate.polygon->is_rectangle() || plate.fills_rectangle, plate.open_back});
  }
  // Without a number of threads: one given would hold for the whole program, not for building the tree only.
  scene_->device = rtcNewDevice("set_affinity=0");
  if (!scene_->device) throw InternalError("the ray casting library did not start");
  scene_->scene = rtcNewScene(scene_->device);
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_->scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene_->plates.size()));
  rtcSetGeometryUserData(geometry, scene_.get());
  rtcSetGeometryBoundsFunction(geometry, Scene::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, Scene::intersect);
  rtcSetGeometryOccludedFunction(geometry, Scene::occluded);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_->scene);
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE)
    throw InternalError("the ray casting library could not take the zone");
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

double RayCaster::tolerance_m() const { return scene_->tolerance_m; }

namespace {

void start(Query& query, const Vec3& origin, const Vec3& direction, double t_min, double t_max, int skip) {
  rtcInitIntersectContext(&query.context);
  query.origin = origin;
  query.direction = direction;
  query.t_min = t_min;
  query.t_max = t_max;
  query.skip = static_cast<unsigned>(skip);
}

void set_ray(RTCRay& ray, const Query& query) {
  ray.org_x = static_cast<float>(query.origin.x);
  ray.org_y = static_cast<float>(query.origin.y);
  ray.org_z = static_cast<float>(query.origin.z);
  ray.dir_x = static_cast<float>(query.direction.x);
  ray.dir_y = static_cast<float>(query.direction.y);
  ray.dir_z = static_cast<float>(query.direction.z);
  ray.tnear = 0.0F;
  ray.tfar = std::isinf(query.t_max) ? std::numeric_limits<float>::infinity() : round_up(query.t_max);
  ray.time = 0.0F;
  ray.mask = ~0U;
  ray.id = 0;
  ray.flags = 0;
}

}  // namespace

Hit RayCaster::nearest(const Vec3& origin, const Vec3& direction, int skip) const {
  Query query;
  start(query, origin, direction, scene_->tolerance_m, std::numeric_limits<double>::infinity(), skip);
  RTCRayHit ray;
  set_ray(ray.ray, query);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_->scene, &query.context, &ray);
  return query.hit;
}

bool RayCaster::blocked(const Vec3& from, const Vec3& to, int skip) const {
  const Vec3 path = to - from;
  const double length_m = glm::length(path);
  const double margin = scene_->tolerance_m / length_m;
  if (!(margin < 0.5)) return false;
  Query query;
  start(query, from, path, margin, 1.0 - margin, skip);
  RTCRay ray;
  set_ray(ray, query);
  rtcOccluded1(scene_->scene, &query.context, &ray);
  return query.hit.plate >= 0;
}

}  // namespace dim
