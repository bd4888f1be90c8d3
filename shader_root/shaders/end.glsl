#pragma once
uint end() { return 9u; }