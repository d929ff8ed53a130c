#pragma once

#include "modules/hair/scattering/fibre.h"
