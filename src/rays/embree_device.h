// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <rtcore.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace droplet {

#if RTC_VERSION_MAJOR >= 4
using RayContext = RTCRayQueryContext;
#else
using RayContext = RTCIntersectContext;
#endif

/// First intersection of one ray, as `ray` says afterwards. `context`, which is initialized here, reaches the filters
/// of the geometries.
inline void intersect(RTCScene scene, RayContext& context, RTCRayHit& ray)
{
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &ray, &arguments);
#else
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#endif
}

/// Whether a ray meets anything.
inline bool isOccluded(RTCScene scene, RTCRay& ray)
{
    RayContext context;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
#else
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
    return ray.tfar < 0.0F;
}

/// Running Embree device. Its scenes must be released first.
class EmbreeDevice {
public:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

    EmbreeDevice() : device_(rtcNewDevice("set_affinity=0"))  // Windows' default binds threads to processors
    {
        if (!device_) {
            throw std::runtime_error("Embree does not start on this machine");
        }
    }

    [[nodiscard]] RTCDevice get() const { return device_.get(); }
    [[nodiscard]] Scene newScene() const { return Scene(rtcNewScene(get())); }
    /// Checks for errors; the only one that correct calls can have is lack of memory.
    /// @throws std::bad_alloc
    void check() const
    {
        if (rtcGetDeviceError(get()) != RTC_ERROR_NONE) {
            throw std::bad_alloc();
        }
    }

private:
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
};

}  // namespace droplet
