// Defines the operations that registers of all instruction sets have in common, in the namespace of
// the current set; see begin.hpp.

namespace harmorph::simd::HARMORPH_SET {

// A register of n numbers. Addresses in memory need no alignment.
template <class Of, Index n>
struct Register {
    static constexpr Index lanes = n;
    using Vector [[gnu::vector_size(n * sizeof(Of))]] = Of;
    // A Word is an unsigned integer as wide as a number, and holds the bits of the number.
    using Word = typename std::conditional<sizeof(Of) == 8, std::uint64_t, std::uint32_t>::type;
    using Words [[gnu::vector_size(n * sizeof(Of))]] = Word;

    static HARMORPH_INLINE Vector load(const Of* from) noexcept {
        return *reinterpret_cast<const Stored*>(from);
    }
    static HARMORPH_INLINE void store(Of* to, Vector v) noexcept {
        *reinterpret_cast<Stored*>(to) = v;
    }
    static HARMORPH_INLINE void store_words(Word* to, Words v) noexcept {
        *reinterpret_cast<StoredWords*>(to) = v;
    }
    // Subtracting 0.0 keeps the bits of x: -0.0 - 0.0 is -0.0.
    static HARMORPH_INLINE Vector all(Of x) noexcept { return x - Vector{}; }

private:
    using Stored [[gnu::vector_size(n * sizeof(Of)), gnu::aligned(sizeof(Of)), gnu::may_alias]] =
        Of;
    using StoredWords
        [[gnu::vector_size(n * sizeof(Of)), gnu::aligned(sizeof(Of)), gnu::may_alias]] = Word;
};

}  // namespace harmorph::simd::HARMORPH_SET
