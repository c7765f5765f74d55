// Embree on a file of triangles and rays, one thread, for `cargo xtask embree`.
//
// Usage: embree FILE. The file holds, in native byte order, two u32 (triangles, rays), then nine
// f32 a triangle (three corners), then six f32 a ray (origin, direction; rays start at 0 and do
// not end).
//
// First prints one line: Embree's version, and the milliseconds that the MEDIUM and the HIGH build
// took, all scenes being ROBUST. Then answers each line of stdin by one line of stdout:
//   time BUILD SIZE        traces all rays and prints the nanoseconds of processor time that took
//   hits BUILD SIZE FILE   traces all rays and writes a u32 and an f32 a ray: triangle, distance
// where BUILD is `medium` or `high`, and SIZE is 1 (rtcIntersect1) or 8 (rtcIntersect8, coherent).

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <time.h>
#include <xmmintrin.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

// Processor time of this thread.
std::chrono::nanoseconds thread_time() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

struct Ray {
    float origin[3];
    float dir[3];
};

struct Hit {
    uint32_t triangle;
    float t;
};

[[noreturn]] void fail(const std::string& message) {
    std::cerr << "embree: " << message << '\n';
    std::exit(2);
}

RTCScene build(RTCDevice device, const std::vector<float>& corners, RTCBuildQuality quality) {
    const size_t triangles = corners.size() / 9;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles));
    for (size_t i = 0; i < corners.size(); ++i) vertices[i] = corners[i];
    for (size_t i = 0; i < 3 * triangles; ++i) indices[i] = static_cast<uint32_t>(i);
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, quality);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

void trace_single(RTCScene scene, const std::vector<Ray>& rays, std::vector<Hit>& hits) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRayHit query{};
        query.ray.org_x = rays[i].origin[0];
        query.ray.org_y = rays[i].origin[1];
        query.ray.org_z = rays[i].origin[2];
        query.ray.dir_x = rays[i].dir[0];
        query.ray.dir_y = rays[i].dir[1];
        query.ray.dir_z = rays[i].dir[2];
        query.ray.tfar = std::numeric_limits<float>::infinity();
        query.ray.mask = ~0u;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &query);
        hits[i] = {query.hit.primID, query.ray.tfar};
    }
}

void trace_packets(RTCScene scene, const std::vector<Ray>& rays, std::vector<Hit>& hits) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t first = 0; first < rays.size(); first += 8) {
        alignas(32) int valid[8];
        RTCRayHit8 query{};
        for (size_t lane = 0; lane < 8; ++lane) {
            const bool used = first + lane < rays.size();
            const Ray& ray = rays[used ? first + lane : first];
            valid[lane] = used ? -1 : 0;
            query.ray.org_x[lane] = ray.origin[0];
            query.ray.org_y[lane] = ray.origin[1];
            query.ray.org_z[lane] = ray.origin[2];
            query.ray.dir_x[lane] = ray.dir[0];
            query.ray.dir_y[lane] = ray.dir[1];
            query.ray.dir_z[lane] = ray.dir[2];
            query.ray.tfar[lane] = std::numeric_limits<float>::infinity();
            query.ray.mask[lane] = ~0u;
            query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            query.hit.primID[lane] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, scene, &context, &query);
        for (size_t lane = 0; lane < 8 && first + lane < rays.size(); ++lane)
            hits[first + lane] = {query.hit.primID[lane], query.ray.tfar[lane]};
    }
}

template <typename T>
std::vector<T> read(std::istream& file, size_t count) {
    std::vector<T> values(count);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    if (!file) fail("the file ends early");
    return values;
}

double milliseconds(Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) fail("usage: embree FILE");
    std::ifstream file(argv[1], std::ios::binary);
    if (!file) fail(std::string(argv[1]) + ": cannot be read");
    const auto counts = read<uint32_t>(file, 2);
    const auto corners = read<float>(file, size_t{9} * counts[0]);
    const auto rays = read<Ray>(file, counts[1]);

    // As Embree's manual advises; it costs Embree nothing and keeps denormals from slowing it.
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    if (!device) fail("no device");
    const auto start = Clock::now();
    RTCScene medium = build(device, corners, RTC_BUILD_QUALITY_MEDIUM);
    const auto between = Clock::now();
    RTCScene high = build(device, corners, RTC_BUILD_QUALITY_HIGH);
    const auto end = Clock::now();
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) fail("cannot build the scene");
    std::cout << RTC_VERSION_STRING << ' ' << milliseconds(between - start) << ' '
              << milliseconds(end - between) << std::endl;

    std::vector<Hit> hits(rays.size());
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream words(line);
        std::string what, quality, path;
        int size = 0;
        words >> what >> quality >> size >> path;
        if ((quality != "medium" && quality != "high") || (size != 1 && size != 8))
            fail("not understood: " + line);
        const auto trace = size == 1 ? trace_single : trace_packets;
        const auto before = thread_time();
        trace(quality == "high" ? high : medium, rays, hits);
        const auto after = thread_time();
        if (what == "hits") {
            std::ofstream out(path, std::ios::binary);
            out.write(reinterpret_cast<const char*>(hits.data()),
                      static_cast<std::streamsize>(hits.size() * sizeof(Hit)));
            out.close();
            if (!out) fail(path + ": cannot be written");
        }
        std::cout << (after - before).count() << std::endl;
    }
    rtcReleaseScene(high);
    rtcReleaseScene(medium);
    rtcReleaseDevice(device);
}
