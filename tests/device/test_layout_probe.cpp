// The device's compiler lays out every struct that crosses the bus as the host's does.
#include "kernels/device/buffers.h"
#include "tests/device/kernels/layouts.h"
#include "tests/support/device.h"

#include <cstddef>
#include <cstring>
#include <numeric>

using namespace parhelion;
using namespace parhelion::test;

namespace {

struct Place {
    const char* name;
    int bytes;
};

#define LAYOUT_TYPE(type) {"size of " #type, sizeof(type)},
#define LAYOUT_FIELD(type, field) {"offset of " #type "::" #field, offsetof(type, field)},
const Place places[] = {LAYOUTS};

/// A struct whose words are first, first + 1, ...
template<class T>
T numbered(int first) {
    std::vector<int> words(sizeof(T) / 4);
    std::iota(words.begin(), words.end(), first);
    T value;
    std::memcpy(&value, words.data(), sizeof value);
    return value;
}

} // namespace

TEST_CASE("Sizes and offsets of all structs that cross the bus are the same on the device",
          "[device]") {
    TestDevice d;
    constexpr std::size_t words = (sizeof(RenderParams) + sizeof(WaveParams)) / 4;
    CHECK(std::size(places) > 100);
    for (const Variant& variant : variants) {
        CAPTURE(variant.name());
        Program program = test_program(d, {"layouts.h", "layout_probe.cl"}, variant);
        Buffer<int> out(d.context, "layout_probe", std::size(places) + words);
        cl::Kernel kernel = program.kernel("layout_probe");
        kernel.setArg(0, out.handle());
        kernel.setArg(1, numbered<RenderParams>(1000));
        kernel.setArg(2, numbered<WaveParams>(2000));
        d.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
        std::vector<int> found = host_copy(d, out);
        program.store(d.cache);
        for (std::size_t i = 0; i < std::size(places); i++) {
            CAPTURE(places[i].name);
            CHECK(found[i] == places[i].bytes);
        }
        int wrong = 0;
        for (std::size_t i = 0; i < words; i++) {
            int params = sizeof(RenderParams) / 4, k = static_cast<int>(i);
            wrong += found[std::size(places) + i] != (k < params ? 1000 + k : 2000 + k - params);
        }
        CHECK(wrong == 0);
    }
}
