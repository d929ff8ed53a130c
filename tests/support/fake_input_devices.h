#pragma once

#include <linux/input.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/own_folder.h"

namespace vellus::test {

/// Event devices that this process sees in /dev/input in place of the machine's own while this
/// lives: fake_input_devices.cpp answers for the kernel. One at a time.
class FakeInputDevices {
  public:
    struct Device {
        std::string name;
        input_id id{};
        std::vector<uint16_t> keys;
        std::vector<uint16_t> axes;
        input_absinfo range{};                 ///< of every axis
        std::array<int32_t, ABS_CNT> state{};  ///< of the axes, by code
    };

    explicit FakeInputDevices(std::vector<Device> devices);
    ~FakeInputDevices();
    FakeInputDevices(const FakeInputDevices&) = delete;
    FakeInputDevices& operator=(const FakeInputDevices&) = delete;

    /// What the device reports next: EV_KEY with a key and 0 or 1, EV_ABS with an axis and a value.
    void send(size_t device, uint16_t type, uint16_t code, int32_t value);

    /// For the kernel's part: an open device, or its folder's place; -1 or null where it is none.
    [[nodiscard]] int open_device(const std::string& path, int flags);
    [[nodiscard]] const Device* opened_as(int descriptor) const;
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

  private:
    std::vector<Device> devices_;
    OwnFolder folder_{"input"};
    std::vector<int> senders_;
    std::vector<int> opened_;  ///< by device; -1 before
};

}  // namespace vellus::test
