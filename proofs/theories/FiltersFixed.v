(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FIX-1] Orientation in 128 and in-circle determinants in 256 bits, for coordinates below 2^60: nothing wraps round,
    and the 256-bit arithmetic of the C code gives the exact sign. *)
From Coq Require Import Bool ZArith Lia.
Open Scope Z_scope.

Definition det2 (ax ay bx by_ : Z) : Z := ax * by_ - ay * bx.
Definition lift (x y : Z) : Z := x * x + y * y.
Definition det3 (ax ay bx by_ cx cy : Z) : Z :=
  lift ax ay * det2 bx by_ cx cy + lift bx by_ * det2 cx cy ax ay + lift cx cy * det2 ax ay bx by_.

(** ** Sizes *)

Lemma mul_bound x y m n : Z.abs x < m -> Z.abs y < n -> Z.abs (x * y) < m * n.
Proof. intros X Y. rewrite Z.abs_mul. apply Z.mul_lt_mono_nonneg; lia. Qed.

Lemma det2_bound ax ay bx by_ : Z.abs ax < 2 ^ 61 -> Z.abs ay < 2 ^ 61 -> Z.abs bx < 2 ^ 61 -> Z.abs by_ < 2 ^ 61 ->
  Z.abs (ax * by_) < 2 ^ 122 /\ Z.abs (ay * bx) < 2 ^ 122 /\ Z.abs (det2 ax ay bx by_) < 2 ^ 123.
Proof.
  intros A B C D. pose proof (mul_bound _ _ _ _ A D) as P. pose proof (mul_bound _ _ _ _ B C) as Q.
  change (2 ^ 61 * 2 ^ 61) with (2 ^ 122) in *. unfold det2. lia.
Qed.

Lemma lift_bound x y : Z.abs x < 2 ^ 61 -> Z.abs y < 2 ^ 61 -> 0 <= lift x y < 2 ^ 123.
Proof.
  intros A B. pose proof (mul_bound _ _ _ _ A A) as P. pose proof (mul_bound _ _ _ _ B B) as Q.
  change (2 ^ 61 * 2 ^ 61) with (2 ^ 122) in *. pose proof (Z.square_nonneg x). pose proof (Z.square_nonneg y).
  unfold lift. lia.
Qed.

(** Orientation: differences fit 64 bits, everything else 128. *)
Theorem orient_fits ax ay bx by_ px py : Z.abs ax < 2 ^ 60 -> Z.abs ay < 2 ^ 60 -> Z.abs bx < 2 ^ 60 -> Z.abs by_ < 2
  ^ 60 ->
  Z.abs px < 2 ^ 60 -> Z.abs py < 2 ^ 60 ->
  Z.abs (ax - px) < 2 ^ 63 /\ Z.abs (ay - py) < 2 ^ 63 /\ Z.abs (bx - px) < 2 ^ 63 /\ Z.abs (by_ - py) < 2 ^ 63 /\
  Z.abs ((ax - px) * (by_ - py)) < 2 ^ 127 /\ Z.abs ((ay - py) * (bx - px)) < 2 ^ 127 /\
  Z.abs (det2 (ax - px) (ay - py) (bx - px) (by_ - py)) < 2 ^ 127.
Proof.
  intros A B C D E F.
  assert (S : forall x y, Z.abs x < 2 ^ 60 -> Z.abs y < 2 ^ 60 -> Z.abs (x - y) < 2 ^ 61) by (clear; intros; lia).
  destruct (det2_bound _ _ _ _ (S _ _ A E) (S _ _ B F) (S _ _ C E) (S _ _ D F)) as (P & Q & R).
  assert (T : forall x y, Z.abs x < 2 ^ 60 -> Z.abs y < 2 ^ 60 -> Z.abs (x - y) < 2 ^ 63) by (clear; intros; lia).
  repeat split; try (apply T; assumption); (eapply Z.lt_trans; [eassumption|reflexivity]).
Qed.

(** ** 256 bits, low half first *)

Notation w64 := (2 ^ 64).
Notation w128 := (2 ^ 128).
Definition i256 := (Z * Z)%type.
Definition value (r : i256) : Z := fst r + w128 * snd r.

(* C src/skeleton/mesh_filter.c product
  bool negative = cross_value < 0;
  u128 x = (u128)lift_value, y = negative ? -(u128)cross_value : (u128)cross_value;
  uint64_t x0 = (uint64_t)x, x1 = (uint64_t)(x >> 64), y0 = (uint64_t)y, y1 = (uint64_t)(y >> 64);
  u128 p00 = (u128)x0 * y0, p01 = (u128)x0 * y1, p10 = (u128)x1 * y0, p11 = (u128)x1 * y1;
  u128 middle = (p00 >> 64) + (uint64_t)p01 + (uint64_t)p10;
  i256 r = {(uint64_t)p00 | middle << 64, p11 + (p01 >> 64) + (p10 >> 64) + (middle >> 64)};
  if (negative) {
    r.low = -r.low;
    r.high = ~r.high + (r.low == 0);
  }
  return r;
*)
Definition school (x y : Z) : i256 :=
  let x0 := x mod w64 in let x1 := x / w64 in let y0 := y mod w64 in let y1 := y / w64 in
  let p00 := (x0 * y0) mod w128 in let p01 := (x0 * y1) mod w128 in
  let p10 := (x1 * y0) mod w128 in let p11 := (x1 * y1) mod w128 in
  let middle := (p00 / w64 + p01 mod w64 + p10 mod w64) mod w128 in
  (Z.lor (p00 mod w64) ((middle * w64) mod w128), (p11 + p01 / w64 + p10 / w64 + middle / w64) mod w128).
Definition product (lift_value cross_value : Z) : i256 :=
  let negative := cross_value <? 0 in
  let x := lift_value mod w128 in
  let y := (if negative then - (cross_value mod w128) else cross_value) mod w128 in
  let (low, high) := school x y in
  if negative then
    let low' := (- low) mod w128 in
    (low', (w128 - 1 - high + (if low' =? 0 then 1 else 0)) mod w128)
  else (low, high).

(* C src/skeleton/mesh_filter.c sum
  i256 r = {a.low + b.low, a.high + b.high};
  r.high += r.low < a.low;
  return r;
*)
Definition sum (a b : i256) : i256 :=
  let low := (fst a + fst b) mod w128 in
  let high := (snd a + snd b) mod w128 in
  (low, (high + (if low <? fst a then 1 else 0)) mod w128).

(** The end of dyd_fixed_incircle: the sign of the signed high half, else whether anything is set. *)
Definition sign_256 (r : i256) : Z :=
  if 2 ^ 127 <=? snd r then -1 else if negb (snd r =? 0) || negb (fst r =? 0) then 1 else 0.

Definition represents (r : i256) (v : Z) : Prop :=
  0 <= fst r < w128 /\ 0 <= snd r < w128 /\ value r mod 2 ^ 256 = v mod 2 ^ 256.

Lemma land_parts a b : 0 <= a < w64 -> Z.land a (Z.shiftl b 64) = 0.
Proof.
  intros A. apply Z.bits_inj'. intros n N. rewrite Z.land_spec, Z.bits_0. destruct (Z_lt_ge_dec n 64) as [L|L].
  - rewrite Z.shiftl_spec_low by exact L. apply andb_false_r.
  - assert (T : Z.testbit a n = false); [|now rewrite T].
    destruct (Z.eq_dec a 0) as [->|Z0]; [apply Z.testbit_0_l|].
    apply Z.bits_above_log2; [apply A|]. apply Z.lt_le_trans with 64; [|apply Z.ge_le, L].
    apply Z.log2_lt_pow2; [|apply A]. destruct A; apply Z.le_neq; split; [assumption|now apply not_eq_sym].
Qed.

Lemma lor_parts a b : 0 <= a < w64 -> Z.lor a (b * w64) = a + b * w64.
Proof.
  intros A. rewrite <- (Z.shiftl_mul_pow2 b 64) by (clear; lia). pose proof (land_parts a b A) as L.
  rewrite Z.add_nocarry_lxor by exact L. symmetry. now apply Z.lxor_lor.
Qed.

Lemma split64 x : 0 <= x < w128 -> 0 <= x mod w64 < w64 /\ 0 <= x / w64 < w64 /\ x = x mod w64 + w64 * (x / w64).
Proof.
  intros X. pose proof (Z.mod_pos_bound x w64 ltac:(lia)). pose proof (Z.div_mod x w64 ltac:(lia)).
  assert (0 <= x / w64) by (apply Z.div_pos; lia).
  assert (x / w64 < w64) by (apply Z.div_lt_upper_bound; [lia|]; change (w64 * w64) with w128; lia). lia.
Qed.

Lemma mul64 a b : 0 <= a < w64 -> 0 <= b < w64 -> 0 <= a * b <= (w64 - 1) * (w64 - 1).
Proof. intros A B. split; [apply Z.mul_nonneg_nonneg; lia|apply Z.mul_le_mono_nonneg; lia]. Qed.

(** The four partial products, exactly. *)
Lemma schoolbook x y : 0 <= x < w128 -> 0 <= y < w128 ->
  let (low, high) := school x y in 0 <= low < w128 /\ 0 <= high < w128 /\ low + w128 * high = x * y.
Proof.
  intros X Y. unfold school. cbv zeta. destruct (split64 x X) as (X0 & X1 & EX).
  destruct (split64 y Y) as (Y0 & Y1 & EY).
  set (x0 := x mod w64) in *. set (x1 := x / w64) in *. set (y0 := y mod w64) in *. set (y1 := y / w64) in *.
  clearbody x0 x1 y0 y1.
  pose proof (mul64 _ _ X0 Y0) as B00. pose proof (mul64 _ _ X0 Y1) as B01.
  pose proof (mul64 _ _ X1 Y0) as B10. pose proof (mul64 _ _ X1 Y1) as B11.
  assert (E : x * y = x0 * y0 + w64 * (x0 * y1 + x1 * y0) + w128 * (x1 * y1)) by (rewrite EX, EY;
    change w128 with (w64 * w64); ring).
  rewrite E. clear E EX EY X Y. revert B00 B01 B10 B11. generalize (x0 * y0) (x0 * y1) (x1 * y0) (x1 * y1).
  clear. intros p00 p01 p10 p11 B00 B01 B10 B11.
  assert (L : forall p, 0 <= p <= (w64 - 1) * (w64 - 1) -> 0 <= p < w128) by (intros; lia).
  rewrite (Z.mod_small p00), (Z.mod_small p01), (Z.mod_small p10), (Z.mod_small p11) by (apply L; assumption).
  destruct (split64 p00 (L _ B00)) as (A0 & A1 & EA). destruct (split64 p01 (L _ B01)) as (C0 & C1 & EC).
  destruct (split64 p10 (L _ B10)) as (D0 & D1 & ED).
  set (a0 := p00 mod w64) in *. set (a1 := p00 / w64) in *. set (c0 := p01 mod w64) in *. set (c1 := p01 / w64) in *.
  set (d0 := p10 mod w64) in *. set (d1 := p10 / w64) in *. clearbody a0 a1 c0 c1 d0 d1.
  rewrite (Z.mod_small (a1 + c0 + d0)) by lia.
  set (m := a1 + c0 + d0) in *. assert (M : 0 <= m < 3 * w64) by lia.
  destruct (split64 m ltac:(lia)) as (M0 & M1 & EM).
  assert (EL : (m * w64) mod w128 = (m mod w64) * w64).
  { change w128 with (w64 * w64). now rewrite Z.mul_mod_distr_r by lia. }
  rewrite EL, lor_parts by exact A0.
  set (m0 := m mod w64) in *. set (m1 := m / w64) in *. clearbody m0 m1.
  rewrite (Z.mod_small (p11 + c1 + d1 + m1)) by lia.
  repeat split; try lia.
Qed.

Theorem product_correct l c : 0 <= l < w128 -> Z.abs c < 2 ^ 127 -> represents (product l c) (l * c).
Proof.
  intros L C. unfold product. cbv zeta. destruct (Z.ltb_spec c 0) as [N|N].
  - assert (Y : (- (c mod w128)) mod w128 = - c).
    { assert (Cm : c mod w128 = c + w128).
      { symmetry. apply Z.mod_unique with (-1); lia. }
      rewrite Cm. symmetry. apply Z.mod_unique with (-1); lia. }
    rewrite Y, (Z.mod_small l) by exact L.
    pose proof (schoolbook l (- c) L ltac:(lia)) as H. destruct (school l (- c)) as [low high].
    destruct H as (A & B & E).
    unfold represents, value. cbn [fst snd]. change (2 ^ 256) with (w128 * w128).
    split; [apply Z.mod_pos_bound; lia|split; [apply Z.mod_pos_bound; lia|]].
    assert (LC : l * c = - (low + w128 * high)) by (rewrite E; ring).
    destruct (Z.eq_dec low 0) as [Z0|Z0].
    + rewrite Z0 in *. change (- 0) with 0. rewrite Z.mod_0_l by lia. cbn [Z.eqb].
      destruct (Z.eq_dec high 0) as [H0|H0].
      * rewrite H0 in *. replace (w128 - 1 - 0 + 1) with (1 * w128) by lia. rewrite Z.mod_mul by lia. rewrite LC.
      f_equal; lia.
      * rewrite (Z.mod_small (w128 - 1 - high + 1)) by lia. rewrite LC.
        replace (0 + w128 * (w128 - 1 - high + 1)) with (- (0 + w128 * high) + 1 * (w128 * w128)) by lia.
        apply Z_mod_plus_full.
    + assert (K : (- low) mod w128 = w128 - low).
      { rewrite <- (Z_mod_plus_full (- low) 1 w128). rewrite Z.mod_small; lia. }
      rewrite K. destruct (Z.eqb_spec (w128 - low) 0) as [H|_]; [lia|].
      rewrite (Z.mod_small (w128 - 1 - high + 0)) by lia. rewrite LC.
      replace (w128 - low + w128 * (w128 - 1 - high + 0)) with (- (low + w128 * high) + 1 * (w128 * w128)) by lia.
      apply Z_mod_plus_full.
  - rewrite (Z.mod_small l) by exact L. rewrite (Z.mod_small c) by lia.
    pose proof (schoolbook l c L ltac:(lia)) as H. destruct (school l c) as [low high]. destruct H as (A & B & E).
    unfold represents, value. cbn [fst snd]. rewrite E. tauto.
Qed.

Theorem sum_correct a b va vb : represents a va -> represents b vb -> represents (sum a b) (va + vb).
Proof.
  intros (A0 & A1 & EA) (B0 & B1 & EB). unfold represents, value, sum in *. cbn [fst snd].
  destruct a as [al ah], b as [bl bh]. cbn [fst snd] in *. change (2 ^ 256) with (w128 * w128) in *.
  split; [apply Z.mod_pos_bound; lia|split; [apply Z.mod_pos_bound; lia|]].
  rewrite (Z.add_mod va vb) by lia. rewrite <- EA, <- EB, <- Z.add_mod by lia.
  assert (Low : (al + bl) mod w128 = al + bl /\ ((al + bl) mod w128 <? al) = false \/
                (al + bl) mod w128 = al + bl - w128 /\ ((al + bl) mod w128 <? al) = true).
  { destruct (Z_lt_ge_dec (al + bl) w128) as [L|L].
    - left. rewrite Z.mod_small by lia. split; [reflexivity|]. apply Z.ltb_ge; lia.
    - right. assert (E : (al + bl) mod w128 = al + bl - w128).
      { rewrite <- (Z_mod_plus_full (al + bl) (-1) w128). rewrite Z.mod_small; lia. }
      rewrite E. split; [reflexivity|]. apply Z.ltb_lt; lia. }
  assert (High : forall k, exists q, ((ah + bh) mod w128 + k) mod w128 = ah + bh + k + q * w128).
  { intros k. rewrite Z.add_mod_idemp_l by lia. exists (- ((ah + bh + k) / w128)).
    pose proof (Z.div_mod (ah + bh + k) w128 ltac:(lia)). lia. }
  destruct Low as [[-> ->]|[-> ->]].
  - destruct (High 0) as [q ->].
    replace (al + bl + w128 * (ah + bh + 0 + q * w128)) with (al + w128 * ah + (bl + w128 * bh) + q * (w128 * w128))
      by ring.
    apply Z_mod_plus_full.
  - destruct (High 1) as [q ->].
    replace (al + bl - w128 + w128 * (ah + bh + 1 + q * w128)) with (al + w128 * ah + (bl + w128 * bh) + q * (w128 *
      w128)) by ring.
    apply Z_mod_plus_full.
Qed.

Theorem sign_correct r v : represents r v -> Z.abs v < 2 ^ 255 -> sign_256 r = Z.sgn v.
Proof.
  intros (A & B & E) V. unfold sign_256, value in *. destruct r as [low high]. cbn [fst snd] in *.
  assert (S : (low + w128 * high) mod 2 ^ 256 = low + w128 * high) by (apply Z.mod_small; lia).
  rewrite S in E. destruct (Z_lt_ge_dec v 0) as [N|N].
  - rewrite <- (Z_mod_plus_full v 1 (2 ^ 256)), Z.mod_small in E by lia.
    destruct (Z.leb_spec (2 ^ 127) high); [|lia]. symmetry; apply Z.sgn_neg; lia.
  - rewrite Z.mod_small in E by lia. destruct (Z.leb_spec (2 ^ 127) high) as [H|_]; [lia|].
    destruct (Z.eqb_spec high 0) as [H|H]; cbn [negb orb].
    + destruct (Z.eqb_spec low 0) as [K|K]; cbn [negb orb].
      * assert (v = 0) by lia; now subst.
      * symmetry; apply Z.sgn_pos; lia.
    + symmetry; apply Z.sgn_pos; lia.
Qed.

(* C src/skeleton/mesh_filter.c dyd_fixed_incircle
  int64_t z[4][2];
  if (m->fixed && m->fixed->z) {
    const uint32_t v[4] = {a, b, c, p};
    for (unsigned k = 0; k < 4; k++) coordinates(z[k], m, v[k]);
  } else if (m->reps->code || !near_coordinates(z, m, (const uint32_t[]){a, b, c, p}))
    return false;
  for (unsigned k = 0; k < 3; k++)
    for (unsigned i = 0; i < 2; i++) z[k][i] -= z[3][i];
  i256 d = product(lift(z[0]), cross(z[1], z[2]));
  d = sum(d, product(lift(z[1]), cross(z[2], z[0])));
  d = sum(d, product(lift(z[2]), cross(z[0], z[1])));
  if ((i128)d.high < 0)
    *sign = -1;
  else
    *sign = d.high != 0 || d.low != 0;
  return true;
*)
Definition fixed_incircle (ax ay bx by_ cx cy px py : Z) : Z :=
  let ax := ax - px in let ay := ay - py in let bx := bx - px in
  let by_ := by_ - py in let cx := cx - px in let cy := cy - py in
  let d := product (lift ax ay) (det2 bx by_ cx cy) in
  let d := sum d (product (lift bx by_) (det2 cx cy ax ay)) in
  let d := sum d (product (lift cx cy) (det2 ax ay bx by_)) in
  sign_256 d.

(** [FIX-1] *)
Theorem fixed_incircle_correct ax ay bx by_ cx cy px py :
  Z.abs ax < 2 ^ 60 -> Z.abs ay < 2 ^ 60 -> Z.abs bx < 2 ^ 60 -> Z.abs by_ < 2 ^ 60 ->
  Z.abs cx < 2 ^ 60 -> Z.abs cy < 2 ^ 60 -> Z.abs px < 2 ^ 60 -> Z.abs py < 2 ^ 60 ->
  fixed_incircle ax ay bx by_ cx cy px py =
    Z.sgn (det3 (ax - px) (ay - py) (bx - px) (by_ - py) (cx - px) (cy - py)).
Proof.
  intros H1 H2 H3 H4 H5 H6 H7 H8.
  assert (S : forall x y, Z.abs x < 2 ^ 60 -> Z.abs y < 2 ^ 60 -> Z.abs (x - y) < 2 ^ 61) by (clear; intros; lia).
  pose proof (S _ _ H1 H7) as Ax. pose proof (S _ _ H2 H8) as Ay. pose proof (S _ _ H3 H7) as Bx.
  pose proof (S _ _ H4 H8) as By. pose proof (S _ _ H5 H7) as Cx. pose proof (S _ _ H6 H8) as Cy.
  unfold fixed_incircle. cbv zeta. revert Ax Ay Bx By Cx Cy.
  generalize (ax - px) (ay - py) (bx - px) (by_ - py) (cx - px) (cy - py). clear.
  intros ax ay bx by_ cx cy Ax Ay Bx By Cx Cy.
  assert (P : forall x y z w q r, Z.abs x < 2 ^ 61 -> Z.abs y < 2 ^ 61 -> Z.abs z < 2 ^ 61 -> Z.abs w < 2 ^ 61 ->
    Z.abs q < 2 ^ 61 -> Z.abs r < 2 ^ 61 -> represents (product (lift x y) (det2 z w q r)) (lift x y * det2 z w q r) /\
    Z.abs (lift x y * det2 z w q r) < 2 ^ 246).
  { clear. intros x y z w q r X Y Z0 W Q R. destruct (lift_bound x y X Y) as [L0 L].
    destruct (det2_bound z w q r Z0 W Q R) as (_ & _ & D). split.
    - apply product_correct.
      + split; [exact L0|]. apply (Z.lt_trans _ _ _ L). reflexivity.
      + apply (Z.lt_trans _ _ _ D). reflexivity.
    - apply Z.lt_le_trans with (2 ^ 123 * 2 ^ 123); [|rewrite <- Z.pow_add_r by (clear; lia); apply Z.le_refl].
      apply mul_bound; [|exact D]. rewrite Z.abs_eq by exact L0. exact L. }
  destruct (P ax ay bx by_ cx cy Ax Ay Bx By Cx Cy) as [RA MA]. destruct (P bx by_ cx cy ax ay Bx By Cx Cy Ax Ay) as
    [RB MB].
  destruct (P cx cy ax ay bx by_ Cx Cy Ax Ay Bx By) as [RC MC].
  unfold det3. apply sign_correct; [now repeat apply sum_correct|].
  revert MA MB MC. generalize (lift ax ay * det2 bx by_ cx cy) (lift bx by_ * det2 cx cy ax ay) (lift cx cy * det2 ax
    ay bx by_).
  clear. intros x y z X Y Z0. assert (K : 2 ^ 255 = 512 * 2 ^ 246) by reflexivity. rewrite K. revert X Y Z0.
  generalize (2 ^ 246). clear. intros w X Y Z0. lia.
Qed.
