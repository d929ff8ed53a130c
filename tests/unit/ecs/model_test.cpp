// Random operations on a World and on the plainest thing that could be one: a map per component.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/ecs/ecs.h"

namespace vellus {
namespace {

struct Small {
    uint8_t value;
};
struct Vector {
    float x, y, z;
};
struct Wide {
    std::array<uint64_t, 7> words;
};
struct alignas(64) Aligned {
    uint32_t value;
};
struct Text {
    std::string text;
};

Small make(std::type_identity<Small>, uint32_t seed) {
    return {static_cast<uint8_t>(seed)};
}
Vector make(std::type_identity<Vector>, uint32_t seed) {
    const auto value = static_cast<float>(seed % 4096);
    return {value, value + 1, value + 2};
}
Wide make(std::type_identity<Wide>, uint32_t seed) {
    return {{seed, seed + 1ULL, seed + 2ULL, seed, seed, seed, seed + 6ULL}};
}
Aligned make(std::type_identity<Aligned>, uint32_t seed) {
    return {seed};
}
Text make(std::type_identity<Text>, uint32_t seed) {
    return {std::string(seed % 40, static_cast<char>('a' + seed % 26))};
}

bool same(const Small& a, const Small& b) {
    return a.value == b.value;
}
bool same(const Vector& a, const Vector& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
bool same(const Wide& a, const Wide& b) {
    return a.words == b.words;
}
bool same(const Aligned& a, const Aligned& b) {
    return a.value == b.value && reinterpret_cast<uintptr_t>(&a) % alignof(Aligned) == 0;
}
bool same(const Text& a, const Text& b) {
    return a.text == b.text;
}

template <class... Ts>
class Model {
  public:
    void spawn(std::mt19937& random) {
        const uint32_t seed = random();
        Entity entity;
        switch (seed % 4) {
            case 0:
                entity = world_.spawn();
                break;
            case 1:
                entity = spawn_with<Vector, Text>(seed);
                break;
            case 2:
                entity = spawn_with<Text, Small, Wide>(seed);
                break;
            default:
                entity = spawn_with<Ts...>(seed);
                break;
        }
        ASSERT_TRUE(all_.insert(entity).second) << "a handle came back";
        alive_.push_back(entity);
    }

    void spawn_many(std::mt19937& random) {
        const uint32_t seed = random();
        const auto entities = world_.template spawn_many<Vector, Aligned>(
            seed % 20, [&](size_t i, Vector& vector, Aligned& aligned) {
                vector = make(std::type_identity<Vector>{}, seed + static_cast<uint32_t>(i));
                aligned = make(std::type_identity<Aligned>{}, seed);
            });
        for (size_t i = 0; i < entities.size(); ++i) {
            ASSERT_TRUE(all_.insert(entities[i]).second) << "a handle came back";
            alive_.push_back(entities[i]);
            keep<Vector>(entities[i], seed + static_cast<uint32_t>(i));
            keep<Aligned>(entities[i], seed);
        }
    }

    void destroy(std::mt19937& random) {
        const Entity entity = pick(random);
        const auto at = std::find(alive_.begin(), alive_.end(), entity);
        ASSERT_EQ(world_.destroy(entity), at != alive_.end());
        if (at == alive_.end()) return;
        alive_.erase(at);
        (std::get<std::map<Entity, Ts>>(components_).erase(entity), ...);
    }

    template <class T>
    void add(std::mt19937& random) {
        const Entity entity = pick(random);
        const uint32_t seed = random();
        const bool alive = std::find(alive_.begin(), alive_.end(), entity) != alive_.end();
        ASSERT_EQ(world_.add(entity, make(std::type_identity<T>{}, seed)), alive);
        if (alive) keep<T>(entity, seed);
    }

    template <class T>
    void remove(std::mt19937& random) {
        const Entity entity = pick(random);
        ASSERT_EQ(world_.template remove<T>(entity), of<T>().erase(entity) == 1);
    }

    void change(std::mt19937& random) {
        const Entity entity = pick(random);
        Text* const text = world_.template get<Text>(entity);
        ASSERT_EQ(text != nullptr, of<Text>().contains(entity));
        if (text == nullptr) return;
        text->text += "a change that makes the text leave its small buffer";
        of<Text>()[entity] = *text;
    }

    /// Everything the world says, against everything the maps say.
    void check() {
        ASSERT_EQ(world_.entity_count(), alive_.size());
        const std::set<Entity> alive(alive_.begin(), alive_.end());
        for (const Entity entity : all_) {
            ASSERT_EQ(world_.alive(entity), alive.contains(entity));
            (check_component<Ts>(entity), ...);
        }
        check_queries();
    }

  private:
    template <class T>
    std::map<Entity, T>& of() {
        return std::get<std::map<Entity, T>>(components_);
    }
    template <class T>
    void keep(Entity entity, uint32_t seed) {
        of<T>()[entity] = make(std::type_identity<T>{}, seed);
    }
    template <class... Us>
    Entity spawn_with(uint32_t seed) {
        const Entity entity = world_.spawn(make(std::type_identity<Us>{}, seed)...);
        (keep<Us>(entity, seed), ...);
        return entity;
    }

    /// Mostly a living one, sometimes any that ever was, rarely nonsense.
    Entity pick(std::mt19937& random) {
        const uint32_t seed = random();
        if (seed % 64 == 0)
            return {static_cast<uint32_t>(random() % 3000), static_cast<uint32_t>(random() % 5)};
        if (seed % 8 == 0 && !all_.empty()) {
            return *std::next(all_.begin(), static_cast<long>(random() % all_.size()));
        }
        return alive_.empty() ? kNoEntity : alive_[random() % alive_.size()];
    }

    template <class T>
    void check_component(Entity entity) {
        const auto expected = of<T>().find(entity);
        const T* const found = std::as_const(world_).template get<T>(entity);
        ASSERT_EQ(found != nullptr, expected != of<T>().end());
        if (found != nullptr) {
            ASSERT_TRUE(same(*found, expected->second));
        }
    }

    void check_queries() {
        std::set<Entity> seen;
        const auto query = world_.template query<const Vector, const Text*, Without<Small>>();
        query.each([&](Entity entity, const Vector& vector, const Text* text) {
            ASSERT_TRUE(seen.insert(entity).second);
            ASSERT_TRUE(same(vector, of<Vector>().at(entity)));
            ASSERT_EQ(text != nullptr, of<Text>().contains(entity));
            if (text != nullptr) {
                ASSERT_TRUE(same(*text, of<Text>().at(entity)));
            }
        });
        std::set<Entity> expected;
        for (const auto& [entity, vector] : of<Vector>()) {
            if (!of<Small>().contains(entity)) expected.insert(entity);
        }
        ASSERT_EQ(seen, expected);
        ASSERT_EQ(query.count(), expected.size());
    }

    World world_;
    std::set<Entity> all_;  // every handle ever given out
    std::vector<Entity> alive_;
    std::tuple<std::map<Entity, Ts>...> components_;
};

class RandomOperations : public testing::TestWithParam<uint32_t> {};

TEST_P(RandomOperations, LeaveWorldAndMapsEqual) {
    std::mt19937 random(GetParam());
    Model<Small, Vector, Wide, Aligned, Text> model;
    for (int i = 0; i < 6000; ++i) {
        switch (random() % 14) {
            case 0:
            case 1:
            case 2:
                model.spawn(random);
                break;
            case 3:
                model.destroy(random);
                break;
            case 4:
                model.add<Small>(random);
                break;
            case 5:
                model.add<Vector>(random);
                break;
            case 6:
                model.add<Wide>(random);
                break;
            case 7:
                model.add<Aligned>(random);
                break;
            case 8:
                model.add<Text>(random);
                break;
            case 9:
                model.remove<Small>(random);
                break;
            case 10:
                model.remove<Vector>(random);
                break;
            case 11:
                model.remove<Wide>(random);
                break;
            case 12:
                model.remove<Text>(random);
                break;
            default:
                model.remove<Aligned>(random);
                break;
        }
        if (i % 10 == 0) model.change(random);
        if (i % 100 == 0) model.spawn_many(random);
        if (i % 4 == 0) model.destroy(random);
        if (i % 500 == 0) model.check();
        if (HasFatalFailure()) FAIL() << "after operation " << i;
    }
    model.check();
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomOperations, testing::Range(1U, 9U));

}  // namespace
}  // namespace vellus
