(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-SMALL] When the coordinates are small multiples of one power of two, the determinants in doubles are exact. *)
From Coq Require Import ZArith Reals Lia Lra Psatz Bool.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle FiltersIncircleAt.
Open Scope R_scope.

(* C src/skeleton/mesh_filter.h dyd_filter_incircle_small
  if (!(i.la + i.lb + i.lc <= m->exact_s)) return false;
  double d = i.la * i.bc + i.lb * i.ca + i.lc * i.ab;
  *sign = (d > 0) - (d < 0);
  return true;
*)
Definition sign_of (d : double) : Z :=
  ((if gt d (lit c_zero) then 1 else 0) - (if lt d (lit c_zero) then 1 else 0))%Z.
Definition filter_incircle_small (exact_s ax ay bx by_ cx cy px py : double) : option Z :=
  let ax := (ax - px)%D in let ay := (ay - py)%D in
  let bx := (bx - px)%D in let by_ := (by_ - py)%D in
  let cx := (cx - px)%D in let cy := (cy - py)%D in
  if le (incircle_s ax ay bx by_ cx cy) exact_s then Some (sign_of (incircle_d ax ay bx by_ cx cy)) else None.

(* C src/skeleton/mesh_filter.c dyd_filter_orient_small
  double ax = a.x - p.x, ay = a.y - p.y, bx = b.x - p.x, by = b.y - p.y;
  if (!(ax * ax + ay * ay + bx * bx + by * by <= m->exact_s)) return false;
  double d = ax * by - ay * bx;
  *sign = (d > 0) - (d < 0);
  return true;
*)
Definition orient_small_s (ax ay bx by_ : double) : double := (ax * ax + ay * ay + bx * bx + by_ * by_)%D.
Definition filter_orient_small (exact_s ax ay bx by_ px py : double) : option Z :=
  let ax := (ax - px)%D in let ay := (ay - py)%D in
  let bx := (bx - px)%D in let by_ := (by_ - py)%D in
  if le (orient_small_s ax ay bx by_) exact_s then Some (sign_of (cross ax ay bx by_)) else None.

Definition sign_R (x : R) : Z := match Rcompare x 0 with Lt => -1 | Eq => 0 | Gt => 1 end.

Lemma sign_of_correct d : finite d -> sign_of d = sign_R (val d).
Proof.
  intros F. destruct (lit_correct c_zero eq_refl) as [Fz Vz].
  assert (Z0 : cval c_zero = 0) by (unfold cval; simpl; lra).
  unfold sign_of, sign_R. generalize (gt_finite d (lit c_zero) F Fz) (lt_finite d (lit c_zero) F Fz). rewrite Vz, Z0.
  case Rcompare_spec; intros H [G1 G2] [L1 L2];
    destruct (gt d (lit c_zero)); destruct (lt d (lit c_zero)); try reflexivity;
    try (specialize (G1 eq_refl); lra); try (specialize (L1 eq_refl); lra);
    try (specialize (G2 H); discriminate); try (specialize (L2 H); discriminate).
Qed.

(** n units of 2^f. *)
Definition unit_of (f n : Z) (x : R) : Prop := x = IZR n * bpow radix2 f.

Lemma unit_format f n x : unit_of f n x -> (Z.abs n <= 2 ^ 53)%Z -> (-1074 <= f)%Z -> format x.
Proof.
  intros -> N F. destruct (Z.eq_dec (Z.abs n) (2 ^ 53)) as [E|E].
  - assert (K : IZR n * bpow radix2 f = F2R (Float radix2 (Z.sgn n) (f + 53))).
    { unfold F2R, Fnum, Fexp. rewrite bpow_plus. change (bpow radix2 53) with (IZR (2 ^ 53)).
      rewrite <- (Z.abs_sgn n) at 1. rewrite E, mult_IZR. ring. }
    rewrite K. apply generic_format_FLT. eexists; [reflexivity| |simpl; lia]. simpl.
    destruct n; simpl; lia.
  - apply generic_format_FLT. exists (Float radix2 n f); [reflexivity| |exact F]. simpl Fnum. simpl Zpower. lia.
Qed.

Lemma unit_small f n x : unit_of f n x -> (Z.abs n <= 2 ^ 53)%Z -> (f <= 900)%Z -> Rabs x < bpow radix2 1024.
Proof.
  intros -> N F. rewrite Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0.
  apply Rle_lt_trans with (bpow radix2 53 * bpow radix2 900).
  - apply Rmult_le_compat; [apply IZR_le; lia|apply bpow_ge_0| |apply bpow_le; exact F].
    change (bpow radix2 53) with (IZR (2 ^ 53)). now apply IZR_le.
  - rewrite <- bpow_plus. apply bpow_lt. lia.
Qed.

Lemma unit_add f n m x y : unit_of f n x -> unit_of f m y -> unit_of f (n + m) (x + y).
Proof. unfold unit_of; intros -> ->. rewrite plus_IZR; ring. Qed.
Lemma unit_sub f n m x y : unit_of f n x -> unit_of f m y -> unit_of f (n - m) (x - y).
Proof. unfold unit_of; intros -> ->. rewrite minus_IZR; ring. Qed.
Lemma unit_mul f g n m x y : unit_of f n x -> unit_of g m y -> unit_of (f + g) (n * m) (x * y).
Proof. unfold unit_of; intros -> ->. rewrite mult_IZR, bpow_plus; ring. Qed.

(** Doubles that hold n units: sums and products are exact as long as they are below 2^53 units. *)
Definition holds (f n : Z) (x : double) : Prop := finite x /\ unit_of f n (val x).

Lemma holds_add f n m x y : holds f n x -> holds f m y -> (-1074 <= f <= 900)%Z -> (Z.abs (n + m) <= 2 ^ 53)%Z ->
  holds f (n + m) (x + y)%D.
Proof.
  intros [Fx X] [Fy Y] F N. pose proof (unit_add _ _ _ _ _ X Y) as U.
  assert (E : rnd (val x + val y) = val x + val y) by (apply rnd_id, (unit_format f (n + m)); [exact U|exact N|lia]).
  destruct (fadd_finite x y Fx Fy) as [G V].
  - rewrite E. apply (unit_small f (n + m)); [exact U|exact N|lia].
  - split; [exact G|]. rewrite V, E. exact U.
Qed.
Lemma holds_sub f n m x y : holds f n x -> holds f m y -> (-1074 <= f <= 900)%Z -> (Z.abs (n - m) <= 2 ^ 53)%Z ->
  holds f (n - m) (x - y)%D.
Proof.
  intros [Fx X] [Fy Y] F N. pose proof (unit_sub _ _ _ _ _ X Y) as U.
  assert (E : rnd (val x - val y) = val x - val y) by (apply rnd_id, (unit_format f (n - m)); [exact U|exact N|lia]).
  destruct (fsub_finite x y Fx Fy) as [G V].
  - rewrite E. apply (unit_small f (n - m)); [exact U|exact N|lia].
  - split; [exact G|]. rewrite V, E. exact U.
Qed.
Lemma holds_mul f g n m x y : holds f n x -> holds g m y -> (-1074 <= f + g <= 900)%Z -> (Z.abs (n * m) <= 2 ^ 53)%Z ->
  holds (f + g) (n * m) (x * y)%D.
Proof.
  intros [Fx X] [Fy Y] F N. pose proof (unit_mul _ _ _ _ _ _ X Y) as U.
  assert (E : rnd (val x * val y) = val x * val y) by (apply rnd_id, (unit_format (f + g) (n * m));
    [exact U|exact N|lia]).
  destruct (fmul_finite x y Fx Fy) as [G V].
  - rewrite E. apply (unit_small (f + g) (n * m)); [exact U|exact N|lia].
  - split; [exact G|]. rewrite V, E. exact U.
Qed.

(** A double that is at least n units, rounded from something that is. *)
Lemma rnd_at_least f n x : (0 <= n <= 2 ^ 53)%Z -> (-1074 <= f)%Z -> IZR n * bpow radix2 f <= x -> IZR n * bpow radix2
  f <= rnd x.
Proof.
  intros N F H. rewrite <- (rnd_id (IZR n * bpow radix2 f)); [now apply rnd_le|].
  apply (unit_format f n); [reflexivity|lia|exact F].
Qed.

Lemma difference_small e x p n m : finite (x - p)%D -> unit_of e n (val x) -> unit_of e m (val p) ->
  (-240 <= e <= 220)%Z -> val (x - p)%D * val (x - p)%D < IZR ((2 ^ 13 + 1) * (2 ^ 13 + 1)) * bpow radix2 (e + e) ->
  holds e (n - m) (x - p)%D /\ (Z.abs (n - m) <= 2 ^ 13)%Z.
Proof.
  intros F X P E L. destruct (fsub_inv _ _ F) as (Fx & Fp & V). pose proof (unit_sub _ _ _ _ _ X P) as U.
  destruct (Z_le_gt_dec (Z.abs (n - m)) (2 ^ 13)) as [K|K].
  - split; [|exact K]. apply holds_sub; try (split; assumption); lia.
  - exfalso. assert (B : IZR (2 ^ 13 + 1) * bpow radix2 e <= Rabs (val (x - p)%D)).
    { rewrite V, <- rnd_abs. apply rnd_at_least; [lia|lia|]. rewrite U, Rabs_mult, <- abs_IZR.
      rewrite (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0. apply Rmult_le_compat_r; [apply bpow_ge_0|]. apply IZR_le;
        lia. }
    assert (P0 : 0 <= IZR (2 ^ 13 + 1) * bpow radix2 e) by (apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]).
    pose proof (Rmult_le_compat _ _ _ _ P0 P0 B B) as Q.
    rewrite <- Rabs_mult, (Rabs_pos_eq (_ * _)) in Q by apply Rle_0_sqr.
    rewrite mult_IZR, bpow_plus in L. lra.
Qed.

(** Every square is at most the computed sum of all. *)
Lemma lift_at_least x y c : format c -> finite (lift x y) -> c <= val x * val x \/ c <= val y * val y -> c <= val
  (lift x y).
Proof.
  intros Fc F H. unfold lift in *. destruct (fadd_inv _ _ F) as (F1 & F2 & E). rewrite E.
  destruct (fmul_inv _ _ F1) as (_ & _ & E1). destruct (fmul_inv _ _ F2) as (_ & _ & E2). rewrite E1, E2.
  assert (P1 : 0 <= rnd (val x * val x)) by (apply rnd_pos, Rle_0_sqr).
  assert (P2 : 0 <= rnd (val y * val y)) by (apply rnd_pos, Rle_0_sqr).
  rewrite <- (rnd_id c) by exact Fc. apply rnd_le.
  destruct H as [H|H]; apply rnd_le in H; rewrite (rnd_id c) in H by exact Fc; lra.
Qed.

Lemma add_at_least x y c : format c -> finite (x + y)%D -> 0 <= val x -> 0 <= val y -> c <= val x \/ c <= val y ->
  c <= val (x + y)%D.
Proof.
  intros Fc F Px Py H. destruct (fadd_inv _ _ F) as (_ & _ & E). rewrite E.
  rewrite <- (rnd_id c) by exact Fc. apply rnd_le. lra.
Qed.

Section Grid.
(** All coordinates are multiples of 2^e. *)
Variable e : Z.
Variable (He : (-240 <= e <= 220)%Z).
Variable exact_s : double.
(** What dyd_fixed_prepare sets: ldexp(1, 26 + 2 * unit). *)
Variable (Hs : finite exact_s /\ val exact_s = bpow radix2 (26 + 2 * e)).
Definition on_grid (x : double) : Prop := exists n, unit_of e n (val x).

Definition limit : R := IZR ((2 ^ 13 + 1) * (2 ^ 13 + 1)) * bpow radix2 (e + e).

Lemma limit_format : format limit.
Proof. apply (unit_format (e + e) ((2 ^ 13 + 1) * (2 ^ 13 + 1))); [reflexivity|lia|lia]. Qed.
Lemma limit_above : val exact_s < limit.
Proof.
  rewrite (proj2 Hs). unfold limit. replace (26 + 2 * e)%Z with (26 + (e + e))%Z by lia. rewrite bpow_plus.
  apply Rmult_lt_compat_r; [apply bpow_gt_0|]. change (bpow radix2 26) with (IZR (2 ^ 26)). apply IZR_lt; lia.
Qed.

Lemma lift_small x y px py n m k l : finite (lift (x - px) (y - py)) -> val (lift (x - px) (y - py)) <= val exact_s ->
  unit_of e n (val x) -> unit_of e m (val px) -> unit_of e k (val y) -> unit_of e l (val py) ->
  holds e (n - m) (x - px)%D /\ holds e (k - l) (y - py)%D /\ (Z.abs (n - m) <= 2 ^ 13)%Z /\ (Z.abs (k - l) <= 2 ^
    13)%Z.
Proof.
  intros F L X P Y Q. destruct (fadd_inv _ _ F) as (F1 & F2 & _).
  destruct (fmul_inv _ _ F1) as (F3 & _ & _). destruct (fmul_inv _ _ F2) as (F4 & _ & _).
  pose proof limit_above as LA.
  destruct (Rlt_or_le (val (x - px)%D * val (x - px)%D) limit) as [A|A].
  2: { pose proof (lift_at_least _ _ limit limit_format F (or_introl A)). lra. }
  destruct (Rlt_or_le (val (y - py)%D * val (y - py)%D) limit) as [B|B].
  2: { pose proof (lift_at_least _ _ limit limit_format F (or_intror B)). lra. }
  destruct (difference_small e x px n m F3 X P He A). destruct (difference_small e y py k l F4 Y Q He B). tauto.
Qed.

Lemma le_exact s : nneg s -> le s exact_s = true -> finite s /\ val s <= val exact_s.
Proof.
  intros N L. assert (F : finite s).
  { destruct s as [?|[|]|? ? ?|? ? ? ?]; try reflexivity; simpl in N; try discriminate.
    all: destruct Hs as [H _]; destruct exact_s; discriminate. }
  split; [exact F|]. now apply le_finite.
Qed.

Lemma holds_lift x y n m : holds e n x -> holds e m y -> (Z.abs n <= 2 ^ 13)%Z -> (Z.abs m <= 2 ^ 13)%Z ->
  holds (e + e) (n * n + m * m) (lift x y).
Proof. intros X Y N M. unfold lift. apply holds_add; [apply holds_mul; [assumption..|lia|nia]|apply holds_mul;
  [assumption..|lia|nia]|lia|nia]. Qed.
Lemma holds_cross bx by_ cx cy n m k l : holds e n bx -> holds e m by_ -> holds e k cx -> holds e l cy ->
  (Z.abs n <= 2 ^ 13)%Z -> (Z.abs m <= 2 ^ 13)%Z -> (Z.abs k <= 2 ^ 13)%Z -> (Z.abs l <= 2 ^ 13)%Z ->
  holds (e + e) (n * l - m * k) (cross bx by_ cx cy).
Proof. intros. unfold cross. apply holds_sub; [apply holds_mul; [assumption..|lia|nia]|apply holds_mul;
  [assumption..|lia|nia]|lia|nia]. Qed.

Theorem filter_orient_small_exact ax ay bx by_ px py sign :
  on_grid ax -> on_grid ay -> on_grid bx -> on_grid by_ -> on_grid px -> on_grid py ->
  filter_orient_small exact_s ax ay bx by_ px py = Some sign ->
  sign = sign_R (orient (val ax) (val ay) (val bx) (val by_) (val px) (val py)).
Proof.
  intros [nax Uax] [nay Uay] [nbx Ubx] [nby Uby] [npx Upx] [npy Upy]. unfold filter_orient_small. cbv zeta.
  destruct (le _ exact_s) eqn:L; [|discriminate]. intros H; injection H as <-.
  apply le_exact in L; [|unfold orient_small_s; repeat first [apply nneg_add|apply nneg_sqr]].
  destruct L as [F L]. unfold orient_small_s in F, L.
  destruct (fadd_inv _ _ F) as (F1 & F2 & _). destruct (fadd_inv _ _ F1) as (F3 & F4 & _).
  destruct (fadd_inv _ _ F3) as (F5 & F6 & _).
  assert (N : forall x : double, 0 <= val (x * x)%D) by (intros x; apply nneg_val, nneg_sqr).
  assert (N3 : 0 <= val ((ax - px) * (ax - px) + (ay - py) * (ay - py))%D) by (apply nneg_val, nneg_add;
    apply nneg_sqr).
  assert (N1 : 0 <= val ((ax - px) * (ax - px) + (ay - py) * (ay - py) + (bx - px) * (bx - px))%D)
    by (apply nneg_val; repeat apply nneg_add; apply nneg_sqr).
  assert (LA : val (lift (ax - px) (ay - py)) <= val exact_s).
  { apply Rle_trans with (2 := L). apply add_at_least; try assumption; [apply val_format|apply N|left].
    apply add_at_least; try assumption; [apply val_format|apply N|left]. unfold lift; lra. }
  destruct (lift_small _ _ _ _ _ _ _ _ F3 LA Uax Upx Uay Upy) as (Hax & Hay & Bax & Bay).
  pose proof limit_above as LB.
  destruct (fmul_inv _ _ F4) as (Fbx & _ & Ebx). destruct (fmul_inv _ _ F2) as (Fby & _ & Eby).
  destruct (Rlt_or_le (val (bx - px)%D * val (bx - px)%D) limit) as [A|A].
  2: { exfalso. apply rnd_le in A. rewrite (rnd_id limit) in A by apply limit_format. rewrite <- Ebx in A.
       pose proof (add_at_least _ _ limit limit_format F1 N3 (N _) (or_intror A)) as K.
       pose proof (add_at_least _ _ limit limit_format F N1 (N _) (or_introl K)). lra. }
  destruct (Rlt_or_le (val (by_ - py)%D * val (by_ - py)%D) limit) as [B|B].
  2: { exfalso. apply rnd_le in B. rewrite (rnd_id limit) in B by apply limit_format. rewrite <- Eby in B.
       pose proof (add_at_least _ _ limit limit_format F N1 (N _) (or_intror B)). lra. }
  destruct (difference_small e bx px nbx npx Fbx Ubx Upx He A) as [Hbx Bbx].
  destruct (difference_small e by_ py nby npy Fby Uby Upy He B) as [Hby Bby].
  destruct (holds_cross _ _ _ _ _ _ _ _ Hax Hay Hbx Hby Bax Bay Bbx Bby) as [Fd Ud].
  rewrite sign_of_correct by exact Fd. f_equal. rewrite Ud. unfold orient.
  rewrite Uax, Uay, Ubx, Uby, Upx, Upy. rewrite bpow_plus, minus_IZR, !mult_IZR, !minus_IZR. ring.
Qed.

Lemma cross_bound n m k l : (2 * Z.abs (n * l - m * k) <= (n * n + m * m) + (k * k + l * l))%Z.
Proof.
  pose proof (Z.square_nonneg (n - l)). pose proof (Z.square_nonneg (m + k)).
  pose proof (Z.square_nonneg (n + l)). pose proof (Z.square_nonneg (m - k)). lia.
Qed.

Lemma square_bound n : (Z.abs n <= 2 ^ 13)%Z -> (0 <= n * n <= 2 ^ 26)%Z.
Proof.
  intros N. split; [apply Z.square_nonneg|]. rewrite <- (Z.abs_square n).
  change (2 ^ 26)%Z with (2 ^ 13 * 2 ^ 13)%Z. apply Z.mul_le_mono_nonneg; lia.
Qed.

Lemma squares_bound n m : (Z.abs n <= 2 ^ 13)%Z -> (Z.abs m <= 2 ^ 13)%Z -> (0 <= n * n + m * m <= 2 ^ 27)%Z.
Proof. intros N M. apply square_bound in N. apply square_bound in M. lia. Qed.

Lemma term_bound a b c x : (0 <= a)%Z -> (0 <= b)%Z -> (0 <= c)%Z -> (2 * Z.abs x <= b + c)%Z ->
  (2 * Z.abs (a * x) <= a * b + a * c)%Z.
Proof. intros A B C X. rewrite Z.abs_mul, (Z.abs_eq a) by exact A. nia. Qed.

Lemma products_bound a b c : (0 <= a)%Z -> (0 <= b)%Z -> (0 <= c)%Z -> (a + b + c <= 2 ^ 26)%Z ->
  (a * b + b * c + c * a <= 2 ^ 52)%Z.
Proof.
  intros A B C S. assert ((a + b + c) * (a + b + c) <= 2 ^ 26 * 2 ^ 26)%Z by (apply Z.mul_le_mono_nonneg; lia).
  pose proof (Z.square_nonneg a). pose proof (Z.square_nonneg b). pose proof (Z.square_nonneg c). 
  pose proof (Z.mul_nonneg_nonneg a b A B). pose proof (Z.mul_nonneg_nonneg b c B C).
  pose proof (Z.mul_nonneg_nonneg c a C A). lia.
Qed.

(** Integers: lifts a, b, c, and cross products x, y, z. *)
Lemma holds_terms la lb lc xa xb xc a b c x y z :
  holds (e + e) a la -> holds (e + e) b lb -> holds (e + e) c lc ->
  holds (e + e) x xa -> holds (e + e) y xb -> holds (e + e) z xc ->
  (0 <= a <= 2 ^ 27)%Z -> (0 <= b <= 2 ^ 27)%Z -> (0 <= c <= 2 ^ 27)%Z ->
  (2 * Z.abs x <= b + c)%Z -> (2 * Z.abs y <= c + a)%Z -> (2 * Z.abs z <= a + b)%Z ->
  val (la + lb + lc)%D <= val exact_s ->
  holds (e + e + (e + e)) (a * x + b * y + c * z) (la * xa + lb * xb + lc * xc)%D.
Proof.
  intros Ga Gb Gc Xa Xb Xc Pa Pb Pc Ca Cb Cc L.
  assert (S : (a + b + c <= 2 ^ 26)%Z).
  { assert (G : holds (e + e) (a + b + c) (la + lb + lc)%D)
      by (apply holds_add; [apply holds_add; [assumption|assumption|lia|lia]|assumption|lia|lia]).
    destruct G as [_ G]. red in G. rewrite G, (proj2 Hs) in L.
    replace (26 + 2 * e)%Z with (26 + (e + e))%Z in L by lia. rewrite (bpow_plus radix2 26) in L.
    apply Rmult_le_reg_r in L; [|apply bpow_gt_0]. change (bpow radix2 26) with (IZR (2 ^ 26)) in L. now apply le_IZR. }
  destruct Pa as [Pa _], Pb as [Pb _], Pc as [Pc _].
  pose proof (products_bound a b c Pa Pb Pc S) as Q.
  pose proof (term_bound a b c x Pa Pb Pc Ca) as Ka.
  pose proof (term_bound b c a y Pb Pc Pa Cb) as Kb.
  pose proof (term_bound c a b z Pc Pa Pb Cc) as Kc.
  pose proof (Z.mul_nonneg_nonneg a b Pa Pb) as Ma. pose proof (Z.mul_nonneg_nonneg b c Pb Pc) as Mb.
  pose proof (Z.mul_nonneg_nonneg c a Pc Pa) as Mc.
  rewrite (Z.mul_comm a c) in Ka. rewrite (Z.mul_comm b a) in Kb. rewrite (Z.mul_comm c b) in Kc.
  clear L S Ca Cb Cc. revert Q Ka Kb Kc Ma Mb Mc.
  generalize (a * b)%Z (b * c)%Z (c * a)%Z. intros ab bc ca Q Ka Kb Kc Ma Mb Mc.
  assert (B1 : (Z.abs (a * x) <= 2 ^ 53)%Z) by (revert Ka; generalize (a * x)%Z; clear - Q Ma Mb Mc; lia).
  assert (B2 : (Z.abs (b * y) <= 2 ^ 53)%Z) by (revert Kb; generalize (b * y)%Z; clear - Q Ma Mb Mc; lia).
  assert (B3 : (Z.abs (c * z) <= 2 ^ 53)%Z) by (revert Kc; generalize (c * z)%Z; clear - Q Ma Mb Mc; lia).
  assert (B4 : (Z.abs (a * x + b * y) <= 2 ^ 53)%Z)
    by (revert Ka Kb; generalize (a * x)%Z (b * y)%Z; clear - Q Ma Mb Mc; lia).
  assert (B5 : (Z.abs (a * x + b * y + c * z) <= 2 ^ 53)%Z)
    by (revert Ka Kb Kc; generalize (a * x)%Z (b * y)%Z (c * z)%Z; clear - Q Ma Mb Mc; lia).
  assert (E1 : (-1074 <= e + e + (e + e) <= 900)%Z) by (clear - He; lia).
  apply holds_add; [|now apply holds_mul|exact E1|exact B5].
  apply holds_add; [now apply holds_mul|now apply holds_mul|exact E1|exact B4].
Qed.

Theorem filter_incircle_small_exact ax ay bx by_ cx cy px py sign :
  on_grid ax -> on_grid ay -> on_grid bx -> on_grid by_ -> on_grid cx -> on_grid cy -> on_grid px -> on_grid py ->
  filter_incircle_small exact_s ax ay bx by_ cx cy px py = Some sign ->
  sign = sign_R (incircle (val ax) (val ay) (val bx) (val by_) (val cx) (val cy) (val px) (val py)).
Proof.
  intros [nax Uax] [nay Uay] [nbx Ubx] [nby Uby] [ncx Ucx] [ncy Ucy] [npx Upx] [npy Upy].
  unfold filter_incircle_small. cbv zeta.
  destruct (le _ exact_s) eqn:L; [|discriminate]. intros H; injection H as <-.
  apply le_exact in L; [|unfold incircle_s, lift; repeat first [apply nneg_add|apply nneg_sqr]].
  destruct L as [F L]. unfold incircle_s in F, L.
  destruct (fadd_inv _ _ F) as (F1 & F2 & _). destruct (fadd_inv _ _ F1) as (F3 & F4 & _).
  pose proof (lift_nonneg _ _ F2) as N2. pose proof (lift_nonneg _ _ F3) as N3. pose proof (lift_nonneg _ _ F4) as N4.
  assert (N1 : 0 <= val (lift (ax - px) (ay - py) + lift (bx - px) (by_ - py))%D)
    by (apply nneg_val, nneg_add; unfold lift; apply nneg_add; apply nneg_sqr).
  assert (LC : val (lift (cx - px) (cy - py)) <= val exact_s).
  { apply Rle_trans with (2 := L). apply add_at_least; try assumption; [apply val_format|right; lra]. }
  assert (LAB : val (lift (ax - px) (ay - py) + lift (bx - px) (by_ - py))%D <= val exact_s).
  { apply Rle_trans with (2 := L). apply add_at_least; try assumption; [apply val_format|left; lra]. }
  assert (LA : val (lift (ax - px) (ay - py)) <= val exact_s).
  { apply Rle_trans with (2 := LAB). apply add_at_least; try assumption; [apply val_format|left; lra]. }
  assert (LB : val (lift (bx - px) (by_ - py)) <= val exact_s).
  { apply Rle_trans with (2 := LAB). apply add_at_least; try assumption; [apply val_format|right; lra]. }
  destruct (lift_small _ _ _ _ _ _ _ _ F3 LA Uax Upx Uay Upy) as (Hax & Hay & Bax & Bay).
  destruct (lift_small _ _ _ _ _ _ _ _ F4 LB Ubx Upx Uby Upy) as (Hbx & Hby & Bbx & Bby).
  destruct (lift_small _ _ _ _ _ _ _ _ F2 LC Ucx Upx Ucy Upy) as (Hcx & Hcy & Bcx & Bcy).
  pose proof (holds_lift _ _ _ _ Hax Hay Bax Bay) as Ga. pose proof (holds_lift _ _ _ _ Hbx Hby Bbx Bby) as Gb.
  pose proof (holds_lift _ _ _ _ Hcx Hcy Bcx Bcy) as Gc.
  pose proof (holds_cross _ _ _ _ _ _ _ _ Hbx Hby Hcx Hcy Bbx Bby Bcx Bcy) as Xa.
  pose proof (holds_cross _ _ _ _ _ _ _ _ Hcx Hcy Hax Hay Bcx Bcy Bax Bay) as Xb.
  pose proof (holds_cross _ _ _ _ _ _ _ _ Hax Hay Hbx Hby Bax Bay Bbx Bby) as Xc.
  pose proof (cross_bound (nbx - npx) (nby - npy) (ncx - npx) (ncy - npy)) as Ca.
  pose proof (cross_bound (ncx - npx) (ncy - npy) (nax - npx) (nay - npy)) as Cb.
  pose proof (cross_bound (nax - npx) (nay - npy) (nbx - npx) (nby - npy)) as Cc.
  pose proof (holds_terms _ _ _ _ _ _ _ _ _ _ _ _ Ga Gb Gc Xa Xb Xc (squares_bound _ _ Bax Bay) (squares_bound _ _ Bbx
    Bby)
    (squares_bound _ _ Bcx Bcy) Ca Cb Cc L) as G.
  destruct G as [Fd Ud]. rewrite sign_of_correct by exact Fd. f_equal. rewrite Ud. unfold incircle, det3.
  rewrite Uax, Uay, Ubx, Uby, Ucx, Ucy, Upx, Upy. rewrite !bpow_plus, !plus_IZR, !mult_IZR.
  rewrite ?plus_IZR, ?minus_IZR, ?mult_IZR, ?minus_IZR. ring.
Qed.
End Grid.
