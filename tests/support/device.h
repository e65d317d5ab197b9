// For the device tests: the device, the kinds of program every kernel comes in, and kernels that
// only tests need.
#pragma once

#include "host/cl/buffer.h"
#include "host/cl/program.h"
#include "host/cl/source.h"
#include "host/numerics/kernel_ways.h"
#include "host/waves/render_device.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace parhelion::test {

/// A context of its own on the default device.
struct TestDevice : RenderDevice {
    TestDevice() : RenderDevice(choose_device("")) {}
};

using Variant = numerics::KernelWay;
inline constexpr auto& variants = numerics::kernel_ways;

inline std::string test_kernel_text(const std::string& name) {
    std::filesystem::path path =
        std::filesystem::path(PARHELION_SOURCE_DIR) / "tests/device/kernels" / name;
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("no test kernel " + path.string());
    return std::string(std::istreambuf_iterator<char>(in), {});
}

/// A program from files of tests/device/kernels, one after the other; the last holds the kernel and
/// gives it its name.
inline Program test_program(const TestDevice& d, const std::vector<std::string>& files,
                            const Variant& variant,
                            const FeatureSet& features = FeatureSet::all()) {
    std::string text;
    for (const std::string& file : files)
        text += fmt::format("#line 1 \"{}\"\n", file) + test_kernel_text(file);
    return Program(d.context, d.device, d.cache,
                   program_source(files.back(), kernel_source(files.back(), text),
                                  {variant.lanes, features, variant.portable}));
}

template<class T>
Buffer<T> device_copy(const TestDevice& d, const char* name, const std::vector<T>& values) {
    return Buffer<T>(d.context, d.queue, name, values.data(), values.size());
}

template<class T>
std::vector<T> host_copy(const TestDevice& d, const Buffer<T>& buffer) {
    std::vector<T> values(buffer.count());
    buffer.read(d.queue, values.data());
    return values;
}

} // namespace parhelion::test
