#include <arboc/page/page.hpp>
#include <iostream>

int main() { std::cout << arboc::page::animation("a < b", "{}"); }
