#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/contract.h"
#include "engine/ecs/type_index.h"

namespace vellus {

/// One value per type. A resource keeps its address for as long as the world lives.
class Resources {
  public:
    Resources() = default;
    Resources(const Resources&) = delete;
    Resources& operator=(const Resources&) = delete;

    /// Inserts the resource, or replaces its value in place.
    template <class T>
    T& insert_resource(T value);
    /// Makes the resource in place, for types that do not move; refused where it exists.
    template <class T, class... Args>
    T& emplace_resource(Args&&... args);
    /// The resource; aborts, naming it, where there is none.
    template <class T>
    [[nodiscard]] T& resource() const;
    /// Null where there is none.
    template <class T>
    [[nodiscard]] T* find_resource() const noexcept {
        return static_cast<T*>(find_resource(kTypeIndex<ResourceFamily, T>));
    }
    [[nodiscard]] void* find_resource(uint32_t index) const noexcept {
        return index < resources_.size() ? resources_[index].get() : nullptr;
    }

  private:
    std::vector<std::shared_ptr<void>> resources_;  // by resource index
};

template <class T>
T& Resources::insert_resource(T value) {
    T* const existing = find_resource<T>();
    if (existing == nullptr) return emplace_resource<T>(std::move(value));
    std::destroy_at(existing);
    return *std::construct_at(existing, std::move(value));
}

template <class T, class... Args>
T& Resources::emplace_resource(Args&&... args) {
    const uint32_t index = kTypeIndex<ResourceFamily, T>;
    if (index >= resources_.size()) resources_.resize(index + 1);
    if (resources_[index] != nullptr) {
        contract_failed(std::string("ecs: resource exists already: ") += type_name<T>());
    }
    resources_[index] = std::make_shared<T>(std::forward<Args>(args)...);
    return *find_resource<T>();
}

template <class T>
T& Resources::resource() const {
    T* const found = find_resource<T>();
    if (found == nullptr) {
        contract_failed(std::string("ecs: no such resource in this world: ") += type_name<T>());
    }
    return *found;
}

}  // namespace vellus
