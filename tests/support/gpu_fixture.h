#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "engine/gpu/buffer.h"
#include "engine/gpu/command_buffer.h"
#include "engine/gpu/device.h"
#include "engine/gpu/image.h"

namespace vellus::test {

/// A headless device with validation, one for the whole program; every test checks that validation
/// stayed silent.
class GpuTest : public testing::Test {
  protected:
    void SetUp() override {
        static const std::unique_ptr<gpu::Device> shared = [] {
            auto made = gpu::Device::create({.validation = true});
            if (!made) ADD_FAILURE() << made.error().message();
            return made ? std::move(*made) : nullptr;
        }();
        device_ = shared.get();
        ASSERT_NE(device_, nullptr);
        messages_before_ = device_->validation_messages();
    }
    void TearDown() override {
        if (device_) {
            EXPECT_EQ(device_->validation_messages(), messages_before_);
        }
    }
    gpu::Device& device() { return *device_; }

  private:
    gpu::Device* device_ = nullptr;
    uint32_t messages_before_ = 0;
};

}  // namespace vellus::test
