#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/component.h"
#include "engine/ecs/table.h"

namespace vellus {

/// A query's type-erased part: which tables it matches, kept up to date as tables appear.
class QueryState {
  public:
    QueryState(std::vector<ComponentId> required, std::vector<ComponentId> excluded)
        : required_(std::move(required)), excluded_(std::move(excluded)) {}

    [[nodiscard]] bool matches(const Table& table) const noexcept;
    void consider(Table& table);
    [[nodiscard]] const std::vector<Table*>& tables() const noexcept { return tables_; }
    [[nodiscard]] size_t count() const noexcept;

  private:
    std::vector<ComponentId> required_;
    std::vector<ComponentId> excluded_;
    std::vector<Table*> tables_;
};

}  // namespace vellus
