float fine() { return 1.0; }

float bad() { return no_such_name; }
