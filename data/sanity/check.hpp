#pragma once

#include "flexspline/data/sanity_check.hpp"
#include "sanity/observed.hpp"
