#pragma once

#include "derham/complex/local_faces.hpp"
