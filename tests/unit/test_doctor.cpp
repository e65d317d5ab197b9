// What `parhelion doctor` reads of control groups, and what it makes of what it has found.
#include "host/commands/diagnosis.h"
#include "host/commands/machine.h"
#include "test_image_tools.h"

#include <sys/resource.h>

using namespace parhelion;
using namespace image_test;

namespace {

/// A file system of a machine: `put("sys/fs/cgroup/cpu.max", "max 100000")`.
class MadeMachine {
public:
    void put(const std::string& file, const std::string& text) const {
        const fs::path path = root_.file(file);
        fs::create_directories(path.parent_path());
        std::ofstream(path) << text << '\n';
    }
    CgroupLimits limits() const { return cgroup_limits(root_.name()); }

private:
    TemporaryFolder root_;
};

Device good_device(int index) {
    Device device;
    device.index = index;
    device.name = "made up";
    device.rounding_option = "-cl-fp32-correctly-rounded-divide-sqrt";
    return device;
}

/// A machine with which nothing is wrong.
Examination healthy() {
    Examination e;
    e.machine = {.processors = 8,
                 .usable_processors = 8,
                 .memory_bytes = std::uint64_t{16} << 30,
                 .free_memory_bytes = std::uint64_t{12} << 30};
    e.devices = {{good_device(0), ""}};
    e.chosen = 0;
    e.cache.name = e.temporary.name = e.current.name = "/tmp";
    return e;
}

/// The one finding there is.
Finding finding(const Examination& e) {
    const std::vector<Finding> all = findings(e);
    REQUIRE(all.size() == 1);
    CHECK(!all[0].to_do.empty());
    return all[0];
}

} // namespace

TEST_CASE("Doctor: limits of control groups, version 2", "[doctor]") {
    // Documentation/admin-guide/cgroup-v2.rst: cpu.max is "$MAX $PERIOD", memory.max bytes or
    // "max".
    MadeMachine machine;
    CHECK(!machine.limits().processors);
    machine.put("proc/self/cgroup", "0::/a/b");
    CHECK(!machine.limits().memory_bytes);
    machine.put("sys/fs/cgroup/a/b/cpu.max", "max 100000");
    machine.put("sys/fs/cgroup/a/b/memory.max", "max");
    CHECK(!machine.limits().processors);
    CHECK(!machine.limits().memory_bytes);
    machine.put("sys/fs/cgroup/a/b/cpu.max", "150000 100000");
    machine.put("sys/fs/cgroup/a/b/memory.max", "1073741824");
    CHECK(machine.limits().processors == 1.5);
    CHECK(machine.limits().memory_bytes == 1073741824u);
    machine.put("sys/fs/cgroup/a/cpu.max", "50000 100000"); // the group above allows less
    machine.put("sys/fs/cgroup/a/memory.max", "2147483648");
    CHECK(machine.limits().processors == 0.5);
    CHECK(machine.limits().memory_bytes == 1073741824u);
    machine.put("sys/fs/cgroup/memory.max", "4096"); // and the root of a container's
    CHECK(machine.limits().memory_bytes == 4096u);
}

TEST_CASE("Doctor: limits of control groups, version 1", "[doctor]") {
    // Documentation/admin-guide/cgroup-v1: a quota of -1 is none, so is the largest number of
    // pages.
    MadeMachine machine;
    machine.put("proc/self/cgroup", "12:cpuset:/\n4:cpu,cpuacct:/job\n3:memory:/job/step\n");
    machine.put("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "-1");
    machine.put("sys/fs/cgroup/cpu/job/cpu.cfs_period_us", "100000");
    machine.put("sys/fs/cgroup/memory/job/step/memory.limit_in_bytes", "9223372036854771712");
    CHECK(!machine.limits().processors);
    CHECK(!machine.limits().memory_bytes);
    machine.put("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "200000");
    machine.put("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "536870912");
    CHECK(machine.limits().processors == 2.0);
    CHECK(machine.limits().memory_bytes == 536870912u);
}

TEST_CASE("Doctor: this machine has what the system's calls say", "[doctor]") {
    const Machine machine = this_machine();
    const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)),
               page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    CHECK(static_cast<double>(machine.memory_bytes) ==
          Approx(static_cast<double>(pages * page)).epsilon(0.001));
    CHECK(machine.free_memory_bytes > 0);
    CHECK(machine.usable_processors >= 1);
    CHECK(machine.processors >= machine.usable_processors);
    CHECK(machine.kernel.starts_with("Linux "));
    rlimit limit{};
    REQUIRE(::getrlimit(RLIMIT_AS, &limit) == 0);
    CHECK(machine.address_space_bytes.has_value() == (limit.rlim_cur != RLIM_INFINITY));
}

TEST_CASE("Doctor: what prevents a render, and what is worth knowing", "[doctor]") {
    CHECK(findings(healthy()).empty());
    Examination e = healthy();

    e.devices.clear(), e.chosen.reset(), e.no_device = "no OpenCL device: none";
    CHECK(finding(e).prevents);

    e = healthy(), e.devices[0].failure = "element 3 is wrong";
    CHECK(finding(e).prevents);
    CHECK_THAT(finding(e).what, Catch::Contains("element 3"));

    e = healthy(), e.devices.push_back({good_device(1), "broken"}); // another is taken
    CHECK(!finding(e).prevents);
    e.chosen = 1;
    CHECK(finding(e).prevents);

    e = healthy(), e.devices[0].device.rounding_option.clear();
    CHECK(!finding(e).prevents);

    e = healthy(), e.bad_cache_size = "PARHELION_CACHE_SIZE is 'x'";
    CHECK(finding(e).prevents);
    e = healthy(), e.cache.name.clear();
    CHECK(!finding(e).prevents);
    e = healthy(), e.cache.why_not = "Read-only file system";
    CHECK_THAT(finding(e).what, Catch::Contains("/tmp") && Catch::Contains("Read-only"));
    e = healthy(), e.temporary = {"", "no folder to compile in"};
    CHECK(finding(e).prevents);
    e = healthy(), e.temporary.why_not = "TMPDIR cannot be used";
    CHECK(!finding(e).prevents);
    e = healthy(), e.current.why_not = "Permission denied";
    CHECK(!finding(e).prevents);

    e = healthy(), e.machine.usable_processors = 2;
    CHECK_THAT(finding(e).what, Catch::Contains("2 of 8"));
    e = healthy(), e.machine.cgroup.processors = 1.5;
    CHECK_THAT(finding(e).what, Catch::Contains("1.5 of 8"));
    e = healthy(), e.machine.cgroup.memory_bytes = 1u << 30;
    CHECK_THAT(finding(e).what, Catch::Contains("1024 of 16384 MB"));
    e = healthy(), e.machine.address_space_bytes = 1u << 30;
    CHECK_THAT(finding(e).what, Catch::Contains("ulimit -v allows 1024 MB"));
    e = healthy(), e.machine.free_memory_bytes = 1u << 20;
    CHECK(!finding(e).prevents);
}
