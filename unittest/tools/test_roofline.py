"""bench/roofline.py: what it counts in a disassembly that is known, and what it refuses to count."""
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent.parent / "bench"))
sys.dont_write_bytecode = True
import roofline

NAME = ("0000000000001000 <int apf::avx512::kernel<apf::PlaneFrame<apf::Pack<64> >, true, true, false, true>"
        "(apf::ContactList&, apf::Bodies&, apf::ContactTimes, apf::ContactParts*)>:\n")
# Groups of sixteen. The loop begins at 1010; histories, at 1100, are kept out of line.
LOOP = """
    1000:\tvdivsd xmm2,xmm2,xmm1
    1004:\tjmp    1050 <x+0x50>
    1010:\tvmovapd zmm1,ZMMWORD PTR [rsp+0x40]
    1014:\tvfmadd213pd zmm1,zmm2,ZMMWORD PTR [rsp+0x80]
    1018:\tvdivpd zmm3,zmm1,zmm2
    101c:\tvrsqrt14pd zmm4,zmm3
    1020:\tvsqrtpd ymm5,ymm4
    1024:\tvxorpd xmm6,xmm6,xmm6
    1028:\tvblendmpd zmm7{k1},zmm4,zmm1
    102c:\tvmovapd zmm2{k1}{z},zmm4
    1030:\tvbroadcastsd zmm8,QWORD PTR [rip+0x200]        # 2000 <y>
    1034:\tvshuff64x2 zmm9,zmm8,zmm8,0x1
    1038:\tvextractf64x4 YMMWORD PTR [rax],zmm9
    103c:\tadd    QWORD PTR [rsp+0x8],0x1
    1040:\tcmp    QWORD PTR [rsp+0x10],rcx
    1044:\tjne    1200 <x+0x200>
    1046:\tvcomisd xmm0,xmm6
    1048:\tlea    rdx,[rax+rcx*8]
    104a:\tja     1100 <x+0x100>
    1050:\tsub    eax,esi
    1054:\tcmp    eax,0xf
    1058:\tjg     1010 <x+0x10>
    105c:\tret
    1100:\tvmovupd ZMMWORD PTR [rdx],zmm2
    1104:\tvaddsd xmm1,xmm1,QWORD PTR [rdx+0x40]
    1108:\tjmp    1050 <x+0x50>
    1200:\tcall   3000 <load>
    1204:\tjmp    1046 <x+0x46>
"""


def loop_of(text):
    return roofline.group_loop(roofline.instructions(text))


class Counts(unittest.TestCase):
    def setUp(self):
        self.loop, self.width = loop_of(LOOP)
        self.n = roofline.count(self.loop)

    def test_loop_is_that_from_1010_with_histories(self):
        self.assertEqual((len(self.loop), self.width), (23, 16))
        self.assertIn("vmovupd ZMMWORD PTR [rdx],zmm2", self.loop)
        self.assertNotIn("vdivsd xmm2,xmm2,xmm1", self.loop)

    def test_sorts(self):
        expected = {"instructions": 23, "loads": 6, ("loads", 512): 2, "stores": 3, ("stores", 512): 1,
                    "divisions": 1, ("divisions", 512): 1, "estimates": 1, ("estimates", 512): 1, "roots": 1,
                    ("roots", 256): 1, "shuffles": 1, ("arithmetic", 512): 3, ("arithmetic", 128): 2}
        self.assertEqual({key: k for key, k in self.n.items() if k}, expected)

    def test_bounds(self):
        cycles = roofline.GOLDEN_COVE.bounds(self.n, "avx512")
        # 5 arithmetic, 1 shuffle, a root, division and estimate of three; division 16, root 9 cycles
        for what, expected in (("issue", 23 / 6), ("loads", 2.0), ("stores", 2.0), ("ports", 13 / 2), ("divider", 25.0)):
            self.assertAlmostEqual(cycles[what], expected, msg=what)
        self.assertAlmostEqual(roofline.GOLDEN_COVE.bounds(self.n, "avx2")["ports"], 13 / 3)

    def test_bounds_of_another_core(self):
        cycles = roofline.ZEN_5.bounds(self.n, "avx512")
        # a root, division and estimate of one micro-operation each; division 4, root 7.5 cycles
        for what, expected in (("issue", 23 / 8), ("loads", 6 / 4), ("ports", 9 / 4), ("divider", 11.5)):
            self.assertAlmostEqual(cycles[what], expected, msg=what)

    def test_core_that_is_not_known_has_no_bound(self):
        times = {"2D/rolling/avx512": (5.0, 0.02)}
        row = roofline.line("2D/rolling/avx512", [NAME + LOOP], times, None, 2.5)
        self.assertEqual(roofline.read_table(row), {"2D/rolling/avx512": (None, 5.0, 0.02)})

    def test_clock_is_that_of_the_chain(self):
        class Arguments:
            clock = None
        self.assertEqual(roofline.find_clock(Arguments, {"clock": (0.25, 0.01)}), (4.0, "by a chain of additions"))
        Arguments.clock = 3.0
        self.assertEqual(roofline.find_clock(Arguments, {"clock": (0.25, 0.01)})[0], 3.0)

    def test_line_is_per_contact(self):
        times = {"2D/rolling/avx512": (5.0, 0.02)}
        words = roofline.line("2D/rolling/avx512", ["other\n", NAME + LOOP], times, roofline.GOLDEN_COVE, 2.5).split()
        self.assertEqual(words[1], "1.4", "23 instructions for 16")
        self.assertEqual(words[-4:], ["0.6", "5.0", "2.0", "8.0"], "25 cycles for 16 at 2.5 GHz")

    def test_table_can_be_read(self):
        times = {"2D/rolling/avx512": (5.0, 0.02), "2D/rolling/scalar": (60.0, 0.01)}
        rows = [roofline.line(name, [NAME + LOOP], times, roofline.GOLDEN_COVE, 2.5) for name in times]
        self.assertEqual(roofline.read_table("\n".join(roofline.HEAD + rows)),
                         {"2D/rolling/avx512": (0.6, 5.0, 0.02), "2D/rolling/scalar": (None, 60.0, 0.01)})
        self.assertEqual(roofline.read_table(roofline.line("2D/rolling/avx512", [NAME + LOOP], {}, roofline.GOLDEN_COVE, 2.5)), {})

    def test_kernel_without_adhesion(self):
        function = (NAME + LOOP).replace("true, true, false, true", "false, true, false, false")
        self.assertEqual(roofline.line("2D/hertz-all/avx512", [function], {}, roofline.GOLDEN_COVE, 2.5).split()[1], "1.4")

    def test_scalar_kernel_has_times_alone(self):
        self.assertEqual(roofline.line("2D/rolling/scalar", [], {"2D/rolling/scalar": (60.0, 0.01)}, roofline.GOLDEN_COVE, 2.5).split(),
                         ["2D/rolling/scalar", "60.0", "1.0"])


class Refusals(unittest.TestCase):
    def refused(self, text, reason):
        with self.assertRaisesRegex(ValueError, reason):
            loop_of(text)

    def test_no_loop(self):
        self.refused(LOOP.replace("jg     1010", "jg     1300"), "0 loops")

    def test_no_division(self):
        self.refused(LOOP.replace("vdivpd", "vaddpd").replace("vsqrtpd", "vmovapd").replace("vrsqrt14pd", "vmovapd"), "0 loops")

    def test_two_loops(self):
        self.refused(LOOP + LOOP.replace("    1", "    5").replace(" 10", " 50").replace(" 11", " 51"), "2 loops")

    def test_call_in_the_round(self):
        self.refused(LOOP.replace("sub    eax,esi", "call   3000 <report>"), "0 loops")

    def test_loop_inside(self):
        self.refused(LOOP.replace("jne    1200", "jne    1018"), "0 loops")

    def test_jump_of_another_sort(self):
        self.refused(LOOP.replace("jne    1200", "ja     1200"), "0 loops")
        self.refused(LOOP.replace("ja     1100", "jb     1100"), "0 loops")

    def test_end_without_the_width(self):
        self.refused(LOOP.replace("cmp    eax,0xf", "cmp    eax,edx"), "the loop ends with 'cmp    eax,edx'")

    def test_kernel_that_is_not_there(self):
        with self.assertRaisesRegex(ValueError, "0 functions int apf::avx2::kernel<apf::SpaceFrame"):
            roofline.kernel([NAME + LOOP], "3D", "rolling", "avx2")
        with self.assertRaisesRegex(ValueError, "2 functions"):
            roofline.kernel([NAME + LOOP] * 2, "2D", "rolling", "avx512")


if __name__ == "__main__":
    unittest.main()
