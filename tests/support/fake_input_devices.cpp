#include "tests/support/fake_input_devices.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <string_view>

namespace vellus::test {

namespace {

constexpr std::string_view kFolder = "/dev/input";

FakeInputDevices* g_devices = nullptr;

void set_bit(uint8_t* bits, size_t bytes, uint32_t bit) {
    if (bit / 8 < bytes) bits[bit / 8] |= static_cast<uint8_t>(1U << bit % 8);
}

/// The bits of EVIOCGBIT(type): types of event for type 0, else codes of that type.
void write_bits(const FakeInputDevices::Device& device, uint32_t type, uint8_t* bits,
                size_t bytes) {
    std::memset(bits, 0, bytes);
    if (type == 0) {
        for (const uint32_t known : {EV_SYN, EV_KEY, EV_ABS}) set_bit(bits, bytes, known);
    }
    if (type == EV_KEY) {
        for (const uint16_t key : device.keys) set_bit(bits, bytes, key);
    }
    if (type == EV_ABS) {
        for (const uint16_t axis : device.axes) set_bit(bits, bytes, axis);
    }
}

/// The requests by which a program asks what an event device is.
int answer(const FakeInputDevices::Device& device, unsigned long request, void* out) {
    const uint32_t number = _IOC_NR(request);
    const size_t bytes = _IOC_SIZE(request);
    if (number == _IOC_NR(EVIOCGID)) {
        std::memcpy(out, &device.id, std::min(bytes, sizeof(device.id)));
    } else if (number == _IOC_NR(EVIOCGNAME(0))) {
        std::memset(out, 0, bytes);
        std::memcpy(out, device.name.data(), std::min(bytes - 1, device.name.size()));
    } else if (number >= _IOC_NR(EVIOCGABS(0))) {
        input_absinfo axis = device.range;
        axis.value = device.state[number - _IOC_NR(EVIOCGABS(0))];
        std::memcpy(out, &axis, std::min(bytes, sizeof(axis)));
    } else if (number >= _IOC_NR(EVIOCGBIT(0, 0))) {
        write_bits(device, number - _IOC_NR(EVIOCGBIT(0, 0)), static_cast<uint8_t*>(out), bytes);
    } else {
        errno = ENOTTY;
        return -1;
    }
    return 0;
}

}  // namespace

FakeInputDevices::FakeInputDevices(std::vector<Device> devices)
    : devices_(std::move(devices)), opened_(devices_.size(), -1) {
    for (size_t i = 0; i < devices_.size(); ++i) {
        const std::string pipe = folder() / fmt::format("event{}", i);
        ::mkfifo(pipe.c_str(), 0600);
        // Open both ways, so that a reader finds nothing yet instead of the end.
        senders_.push_back(::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
    }
    g_devices = this;
}

FakeInputDevices::~FakeInputDevices() {
    g_devices = nullptr;
    for (const int sender : senders_) ::close(sender);
}

void FakeInputDevices::send(size_t device, uint16_t type, uint16_t code, int32_t value) {
    if (type == EV_ABS) devices_[device].state[code] = value;
    input_event events[2] = {};
    events[0].type = type;
    events[0].code = code;
    events[0].value = value;
    events[1].type = EV_SYN;
    events[1].code = SYN_REPORT;
    const ssize_t written = ::write(senders_[device], events, sizeof(events));
    if (written != sizeof(events)) std::abort();
}

int FakeInputDevices::open_device(const std::string& path, int flags) {
    for (size_t i = 0; i < devices_.size(); ++i) {
        const std::string name = fmt::format("event{}", i);
        if (path != fmt::format("{}/{}", kFolder, name)) continue;
        opened_[i] =
            static_cast<int>(::syscall(SYS_openat, AT_FDCWD, (folder() / name).c_str(), flags, 0));
        return opened_[i];
    }
    errno = ENOENT;
    return -1;
}

const FakeInputDevices::Device* FakeInputDevices::opened_as(int descriptor) const {
    const auto found = std::ranges::find(opened_, descriptor);
    return found == opened_.end() ? nullptr : &devices_[found - opened_.begin()];
}

}  // namespace vellus::test

// The program's own definitions come before those of the C library, for shared libraries too.
extern "C" {

int open(const char* path, int flags, ...) {
    using vellus::test::g_devices;
    if (g_devices && std::string_view(path).starts_with(vellus::test::kFolder)) {
        return g_devices->open_device(path, flags);
    }
    va_list arguments;
    va_start(arguments, flags);
    const bool creates = (flags & (O_CREAT | O_TMPFILE)) != 0;
    const mode_t mode = creates ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

DIR* opendir(const char* path) {
    using vellus::test::g_devices;
    const bool ours = g_devices && path == vellus::test::kFolder;
    const int folder =
        ::open(ours ? g_devices->folder().c_str() : path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return folder < 0 ? nullptr : ::fdopendir(folder);
}

int ioctl(int descriptor, unsigned long request, ...) noexcept {
    va_list arguments;
    va_start(arguments, request);
    void* out = va_arg(arguments, void*);
    va_end(arguments);
    using vellus::test::g_devices;
    if (const auto* device = g_devices ? g_devices->opened_as(descriptor) : nullptr) {
        return vellus::test::answer(*device, request, out);
    }
    return static_cast<int>(::syscall(SYS_ioctl, descriptor, request, out));
}

}  // extern "C"
