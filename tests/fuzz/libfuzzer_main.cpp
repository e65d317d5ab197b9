// What libFuzzer calls for every input of the target FUZZ_TARGET.
#include "targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return parhelion::fuzz::FUZZ_TARGET(data, size);
}
