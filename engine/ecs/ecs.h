#pragma once

// All of the ECS: World, Query, Res, Commands, Schedule.
#include "engine/ecs/commands.h"
#include "engine/ecs/query.h"
#include "engine/ecs/schedule.h"
#include "engine/ecs/world.h"
