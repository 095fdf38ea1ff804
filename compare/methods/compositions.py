"""Palindromic compositions of Verlet's step, of order 6, 8 and 10, by the weights that their sources print.

The zero of the order conditions is near them: Yoshida's tables are printed to 15 digits, of which the last one to five
are wrong; Suzuki and Umeno's, Kahan and Li's and Sofroniou and Spaletta's are right to the last place.
"""

from compare.methods.order.refined import proven_composition
from compare.methods.symplectic import POSITION_VERLET, VERLET

__all__ = [
    "COMPOSITIONS",
    "KAHAN_LI6",
    "KAHAN_LI8",
    "SOFRONIOU_SPALETTA10",
    "SUZUKI_UMENO8",
    "YOSHIDA6",
    "YOSHIDA6B",
    "YOSHIDA6C",
    "YOSHIDA8",
    "YOSHIDA8A",
    "YOSHIDA8B",
    "YOSHIDA8C",
    "YOSHIDA8E",
]

YOSHIDA = "Yoshida 1990, Phys. Lett. A 150, 262, table"

YOSHIDA6 = proven_composition(
    POSITION_VERLET, "yoshida6", 6, f"{YOSHIDA} 1, solution A",
    ("0.784513610477560", "0.235573213359357", "-1.17767998417887"),
    slack=3, aliases=("yoshida6a",),
)  # fmt: skip

YOSHIDA6B = proven_composition(
    POSITION_VERLET, "yoshida6b", 6, f"{YOSHIDA} 1, solution B",
    ("1.43984816797678", "0.00426068187079180", "-2.13228522200144"),
    slack=22,
)  # fmt: skip

YOSHIDA6C = proven_composition(
    POSITION_VERLET, "yoshida6c", 6, f"{YOSHIDA} 1, solution C",
    ("1.44778256239930", "-2.14403531630539", "0.00152886228424922"),
    slack=6,
)  # fmt: skip

YOSHIDA8A = proven_composition(
    POSITION_VERLET, "yoshida8a", 8, f"{YOSHIDA} 2, solution A",
    (
        "1.04242620869991", "1.82020630970714", "0.157739928123617", "2.44002732616735", "-0.00716989419708120",
        "-2.44699182370524", "-1.61582374150097",
    ),
    slack=1414,
)  # fmt: skip

YOSHIDA8B = proven_composition(
    POSITION_VERLET, "yoshida8b", 8, f"{YOSHIDA} 2, solution B",
    (
        "1.48819229202922", "-2.33864815101035", "2.89105148970595", "-2.89688250328827", "0.00378039588360192",
        "2.89195744315849", "-0.00169248587770116",
    ),
    slack=2477,
)  # fmt: skip

YOSHIDA8C = proven_composition(
    POSITION_VERLET, "yoshida8c", 8, f"{YOSHIDA} 2, solution C",
    (
        "0.629030650210433", "1.36934946416871", "-1.06458714789183", "1.66335809963315", "-1.67896928259640",
        "-1.55946803821447", "0.311790812418427",
    ),
    slack=63,
)  # fmt: skip

YOSHIDA8 = proven_composition(
    POSITION_VERLET, "yoshida8", 8, f"{YOSHIDA} 2, solution D",
    (
        "0.914844246229740", "0.253693336566229", "-1.44485223686048", "-0.158240635368243", "1.93813913762276",
        "-1.96061023297549", "0.102799849391985",
    ),
    slack=193, aliases=("yoshida8d",),
)  # fmt: skip

YOSHIDA8E = proven_composition(
    POSITION_VERLET, "yoshida8e", 8, f"{YOSHIDA} 2, solution E",
    (
        "1.30300165760014", "0.107990467703699", "-2.04809795887393", "0.00536018921307285", "-0.0719180053552772",
        "2.52778927322839", "0.0227738840094906",
    ),
    slack=97934,
)  # fmt: skip

KAHAN_LI6 = proven_composition(
    VERLET, "kahan_li6", 6, "Kahan and Li 1997, Math. Comp. 66, 1089, s9odr6a",
    (
        "0.39216144400731413927925056", "0.33259913678935943859974864", "-0.70624617255763935980996482",
        "0.08221359629355080023149045",
    ),
    kept=(1,),
)  # fmt: skip

SUZUKI_UMENO8 = proven_composition(
    VERLET, "suzuki_umeno8", 8,
    "Suzuki and Umeno 1993, Computer Simulation Studies in Condensed-Matter Physics VI, 74; "
    "McLachlan 1995, SIAM J. Sci. Comput. 16, 151",
    (
        "0.74167036435061295344822780", "-0.40910082580003159399730010", "0.19075471029623837995387626",
        "-0.57386247111608226665638773", "0.29906418130365592384446354", "0.33462491824529818378495798",
        "0.31529309239676659663205666",
    ),
    aliases=("mclachlan8",),
)  # fmt: skip

KAHAN_LI8 = proven_composition(
    VERLET, "kahan_li8", 8, "Kahan and Li 1997, Math. Comp. 66, 1089, s17odr8a",
    (
        "0.13020248308889008087881763", "0.56116298177510838456196441", "-0.38947496264484728640807860",
        "0.15884190655515560089621075", "-0.39590389413323757733623154", "0.18453964097831570709183254",
        "0.25837438768632204729397911", "0.29501172360931029887096624",
    ),
    kept=(4,),
)  # fmt: skip

SOFRONIOU_SPALETTA10 = proven_composition(
    VERLET, "sofroniou_spaletta10", 10, "Sofroniou and Spaletta 2005, Optim. Methods Softw. 20, 597",
    (
        "0.07879572252168641926390768", "0.31309610341510852776481247", "0.02791838323507806610952027",
        "-0.22959284159390709415121340", "0.13096206107716486317465686", "-0.26973340565451071434460973",
        "0.07497334315589143566613711", "0.11199342399981020488957508", "0.36613344954622675119314812",
        "-0.39910563013603589787862981", "0.10308739852747107731580277", "0.41143087395589023782070412",
        "-0.00486636058313526176219566", "-0.39203335370863990644808194", "0.05194250296244964703718290",
        "0.05066509075992449633587434", "0.04967437063972987905456880",
    ),
    kept=(10, 16), aliases=("sofspa10",),
)  # fmt: skip

COMPOSITIONS = (
    YOSHIDA6, YOSHIDA6B, YOSHIDA6C, KAHAN_LI6,
    YOSHIDA8, YOSHIDA8A, YOSHIDA8B, YOSHIDA8C, YOSHIDA8E, SUZUKI_UMENO8, KAHAN_LI8,
    SOFRONIOU_SPALETTA10,
)  # fmt: skip
