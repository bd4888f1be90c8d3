float a;
float b;
float c;
float d;
float e;
float f;
