(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-STAR] What star_filter.c concludes: an edge has its centre as witness, a hull vertex is surely farthest; for
    representatives that are off their doubles by delta. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz List.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle FiltersIncircleAt
  FiltersDistance FiltersInterval FiltersNearRound FiltersNearPlane FiltersDirection FiltersDirectionBox FiltersStar.
From Dyadel Require Import Plane Distance Cells Legal.
Open Scope R_scope.

(* [FLT-STAR] src/legal/star_filter.c: (a + b > need + {} * (fabs(a) *)
Definition c_star_hull : const := (1, -50)%Z.

(* C src/legal/star_filter.c certify_hull
  int next = (s->ghost + 1) % s->degree, before = (s->ghost + s->degree - 1) % s->degree;
  dyd_xy v = p->sk->reps.xy[s->v];
  double ux = s->y[next] - s->y[before], uy = s->x[before] - s->x[next];
  double need = p->reach * sqrt(dyd_upper(ux * ux + uy * uy)) * DYD_UP_FACTOR;
  if (p->fat.count) return;
  for (int k = 0; k < s->degree; k++) {
    if (k == s->ghost) continue;
    double a = ux * (v.x - s->x[k]), b = uy * (v.y - s->y[k]);
    if (!(a + b > need + 8 * 0x1p-53 * (fabs(a) + fabs(b)) + DYD_TINY)) return;
  }
  star_mark(p->sk, s->edge[s->ghost]);
  star_mark(p->sk, dyd_edge_twin(&p->sk->mesh, s->edge[s->ghost]));
*)
Definition surely_lower (ux uy vx vy kx ky reach : double) : bool :=
  let need := (reach * fsqrt (upper (lift ux uy)) * lit c_up_factor)%D in
  let a := (ux * (vx - kx))%D in let b := (uy * (vy - ky))%D in
  gt (a + b) (need + lit c_star_hull * (fabs a + fabs b) + lit c_tiny).
(** The answer of certify_hull where no rectangle is fat: v is farther by enough than all others but the ghost. *)
Definition star_hull (v : double * double) (star : list (double * double)) (ghost : nat) (reach : double) : bool :=
  let next := nth ((ghost + 1) mod length star) star nowhere in
  let before := nth ((ghost + length star - 1) mod length star) star nowhere in
  let ux := (snd next - snd before)%D in let uy := (fst before - fst next)%D in
  forallb (fun k => Nat.eqb k ghost ||
    surely_lower ux uy (fst v) (snd v) (fst (nth k star nowhere)) (snd (nth k star nowhere)) reach) (seq 0 (length star)).

(** ** The rounding *)

Lemma component_error w x y : finite (w * (x - y))%D ->
  Rabs (val (w * (x - y))%D - val w * (val x - val y)) <= 21 / 10 * u * Rabs (val (w * (x - y))%D) + 3 * eta.
Proof.
  intros F. destruct (fmul_inv _ _ F) as (_ & F1 & E). destruct (fsub_inv _ _ F1) as (_ & _ & E1).
  pose proof (product_error (val w) (val (x - y)%D)) as P. rewrite <- E in P.
  pose proof (rnd_sub_error _ _ (val_format x) (val_format y)) as D. rewrite <- E1 in D.
  set (d := val (x - y)%D) in *. set (a := val (w * (x - y))%D) in *. set (e := val x - val y) in *.
  pose proof eta_pos as EP.
  assert (Q : Rabs e <= Rabs d * (1 + 2 * u)).
  { pose proof (Rabs_triang d (- (d - e))) as T. rewrite Rabs_Ropp in T. replace (d + - (d - e)) with e in T by ring.
    pose proof (Rabs_pos d). unfold u in *; lra. }
  pose proof (Rabs_pos d) as Pd.
  assert (D' : Rabs (d - e) <= 101 / 100 * u * Rabs d) by (unfold u in *; lra).
  assert (M : Rabs (val w * (d - e)) <= 101 / 100 * u * Rabs (val w * d)).
  { rewrite !Rabs_mult. assert (Rabs (val w) * Rabs (d - e) <= Rabs (val w) * (101 / 100 * u * Rabs d)) by (apply
      Rmult_le_compat_l; [apply Rabs_pos|exact D']). lra. }
  pose proof (Rabs_triang (val w * d - a) a) as T. replace (val w * d - a + a) with (val w * d) in T by ring.
  rewrite Rabs_minus_sym in T.
  pose proof (Rabs_triang (a - val w * d) (val w * (d - e))) as S.
  replace (a - val w * d + val w * (d - e)) with (a - val w * e) in S by ring.
  pose proof (Rabs_pos a). unfold u in *; lra.
Qed.

Definition length (x y : R) : R := sqrt (x * x + y * y).

(** Along (ux,uy) the double of v is farther than that of k by the reach. *)
Theorem surely_lower_correct ux uy vx vy kx ky reach : nneg reach ->
  surely_lower ux uy vx vy kx ky reach = true ->
  finite vx /\ finite vy /\ finite kx /\ finite ky /\
  val reach * (1 + 3 * u) * length (val ux) (val uy) < val ux * (val vx - val kx) + val uy * (val vy - val ky).
Proof.
  intros Nr. unfold surely_lower. cbv zeta. set (a := (ux * (vx - kx))%D). set (b := (uy * (vy - ky))%D).
  set (need := (reach * fsqrt (upper (lift ux uy)) * lit c_up_factor)%D).
  set (q := (lit c_star_hull * (fabs a + fabs b))%D). intros G.
  pose proof eta_323 as H323. pose proof eta_pos as EP. pose proof tiny_value as TV. pose proof tiny_eta as TE.
  assert (Nn : nneg need).
  { unfold need. repeat apply nneg_mul; [exact Nr|apply nneg_sqrt|apply nneg_lit; [reflexivity|simpl; lia]]. }
  assert (Nq : nneg q) by (apply nneg_mul; [apply nneg_lit; [reflexivity|simpl; lia]|apply nneg_add; apply nneg_abs]).
  assert (Ne : nneg (need + q + lit c_tiny)%D) by (repeat apply nneg_add; try assumption; apply nneg_lit; [reflexivity|simpl;
    lia]).
  pose proof (gt_nneg_finite _ _ Ne G) as Fe. destruct (fadd_inv _ _ Fe) as (Fnq & Ft & Ee).
  destruct (fadd_inv _ _ Fnq) as (Fn & Fq & Enq). unfold q in Fq. destruct (fmul_inv _ _ Fq) as (_ & FT & Eq). fold q in Eq.
  destruct (fadd_inv _ _ FT) as (Fa & Fb & ET). rewrite fabs_finite in Fa, Fb. rewrite !fabs_val in ET.
  pose proof (component_error ux vx kx Fa) as Ea. pose proof (component_error uy vy ky Fb) as Eb. fold a in Ea. fold b in Eb.
  unfold a in Fa. unfold b in Fb. destruct (fmul_inv _ _ Fa) as (_ & Fdx & _). destruct (fmul_inv _ _ Fb) as (_ & Fdy & _).
  destruct (fsub_inv _ _ Fdx) as (Fvx & Fkx & _). destruct (fsub_inv _ _ Fdy) as (Fvy & Fky & _).
  fold a in Fa. fold b in Fb. repeat (split; [assumption|]).
  apply (fadd_gt _ _ _ Fa Fb Fe) in G.
  pose proof (rnd_add_error _ _ (val_format a) (val_format b)) as Eab.
  set (T := Rabs (val a) + Rabs (val b)) in *.
  pose proof (Rabs_pos (val a)) as Pa. pose proof (Rabs_pos (val b)) as Pb.
  assert (PT : 0 <= T) by (unfold T; lra).
  assert (Sab : Rabs (val a + val b) <= T) by apply Rabs_triang.
  assert (Eab' : Rabs (rnd (val a + val b) - (val a + val b)) <= u * T).
  { apply Rle_trans with (1 := Eab). apply Rmult_le_compat_l; [unfold u; lra|exact Sab]. }
  (* the need *)
  unfold need in Fn. destruct (fmul_inv _ _ Fn) as (Frq & _ & En). destruct (fmul_inv _ _ Frq) as (Fr & Fs & Erq).
  destruct (fsqrt_inv _ Fs) as (Fup & _ & Es). fold need in Fn, En.
  pose proof Fup as Fm. unfold upper in Fm. destruct (fadd_inv _ _ Fm) as (Fm1 & _ & Em). destruct (fmul_inv _ _ Fm1) as (Fm2 &
    _ & Em1).
  set (l := lift ux uy) in *. set (U := length (val ux) (val uy)).
  assert (UU : U * U = val ux * val ux + val uy * val uy).
  { apply sqrt_sqrt. generalize (Rle_0_sqr (val ux)) (Rle_0_sqr (val uy)); unfold Rsqr; lra. }
  assert (PU : 0 <= U) by apply sqrt_pos.
  assert (XX : 0 <= val ux * val ux) by apply Rle_0_sqr. assert (YY : 0 <= val uy * val uy) by apply Rle_0_sqr.
  assert (R2 : U * U <= val (upper l)).
  { destruct (upper_correct l (U * U)) as [E|[_ H]]; [apply Rle_0_sqr| |rewrite E in Fup; discriminate|exact H].
    right. split; [exact Fm2|]. split; [apply nneg_val, lift_nneg|]. unfold l, lift in *.
    destruct (fadd_inv _ _ Fm2) as (G1 & G2 & E). destruct (fmul_inv _ _ G1) as (_ & _ & E1).
    destruct (fmul_inv _ _ G2) as (_ & _ & E2). rewrite E, E1, E2, UU.
    pose proof (rnd_lower _ XX). pose proof (rnd_lower _ YY). pose proof (rnd_pos _ XX). pose proof (rnd_pos _ YY).
    assert ((rnd (val ux * val ux) + rnd (val uy * val uy)) * (1 - u) <= rnd (rnd (val ux * val ux) + rnd (val uy * val uy)))
      by (apply rnd_add_lower; try apply rnd_format; lra).
    unfold u in *; lra. }
  assert (R3 : 9 / 10 ^ 302 <= val (upper l)).
  { unfold upper. rewrite Em. apply Rle_trans with (1 := TV). rewrite (proj2 (lit_correct c_tiny eq_refl)).
    rewrite <- (rnd_id (cval c_tiny)) at 1 by (rewrite <- (proj2 (lit_correct c_tiny eq_refl)); apply val_format).
    apply rnd_le. assert (0 <= val (l * lit c_up_factor)%D); [|lra]. apply nneg_val. apply nneg_mul; [apply lift_nneg|].
    apply nneg_lit; [reflexivity|simpl; lia]. }
  assert (S1 : U <= sqrt (val (upper l))) by (rewrite <- (sqrt_square U) by exact PU; now apply sqrt_le_1_alt).
  assert (S2 : 3 / 10 ^ 151 <= sqrt (val (upper l))).
  { rewrite <- (sqrt_square (3 / 10 ^ 151)) by lra. apply sqrt_le_1_alt. lra. }
  assert (S3 : U * (1 - 11 / 10 * u) <= val (fsqrt (upper l))).
  { rewrite Es. pose proof (rnd_lower _ (sqrt_pos (val (upper l)))). unfold u in *; lra. }
  pose proof (nneg_val _ Nr) as Pr.
  assert (S4 : 0 <= val (fsqrt (upper l))) by (apply nneg_val, nneg_sqrt).
  assert (RU : 0 <= val reach * U) by now apply Rmult_le_pos.
  assert (N1 : val reach * (U * (1 - 11 / 10 * u)) <= val reach * val (fsqrt (upper l))) by now apply Rmult_le_compat_l.
  assert (N2 : val reach * val (fsqrt (upper l)) * (1 - u) - eta <= val (reach * fsqrt (upper l))%D).
  { rewrite Erq. apply rnd_lower. now apply Rmult_le_pos. }
  assert (N3 : 0 <= val (reach * fsqrt (upper l))%D) by (rewrite Erq; apply rnd_pos; now apply Rmult_le_pos).
  pose proof factor_up as Up. destruct up_lit as (_ & Vu & _). rewrite Vu in En.
  assert (N4 : val (reach * fsqrt (upper l))%D * (1 + 10 * u) <= val (reach * fsqrt (upper l))%D * cval c_up_factor) by (apply
    Rmult_le_compat_l; lra).
  assert (N5 : val (reach * fsqrt (upper l))%D * cval c_up_factor * (1 - u) - eta <= val need).
  { rewrite En. apply rnd_lower, Rmult_le_pos; [exact N3|unfold u in Up; lra]. }
  assert (Need : val reach * U * (1 + 6 * u) - 3 * eta <= val need) by (unfold u in *; lra).
  (* the bound *)
  assert (C : cval c_star_hull = 8 * u) by (unfold c_star_hull, u; numerals; lra).
  rewrite (proj2 (lit_correct c_star_hull eq_refl)), C in Eq. rewrite (proj2 (lit_correct c_tiny eq_refl)) in Ee.
  assert (T1 : T * (1 - u) <= val (fabs a + fabs b)%D).
  { rewrite ET. apply rnd_add_lower; try (apply generic_format_abs, val_format). exact PT. }
  assert (T2 : 0 <= 8 * u * val (fabs a + fabs b)%D) by (apply Rmult_le_pos; unfold u in *; lra).
  pose proof (rnd_lower _ T2) as Q1. rewrite <- Eq in Q1. pose proof (nneg_val _ Nn) as Pn. pose proof (nneg_val _ Nq) as Pq.
  assert (Q2 : (val need + val q) * (1 - u) <= val (need + q)%D) by (rewrite Enq; apply rnd_add_lower; try apply val_format;
    lra).
  assert (Q3 : 0 <= val (need + q)%D) by (rewrite Enq; apply rnd_pos; lra).
  assert (Q4 : (val (need + q)%D + cval c_tiny) * (1 - u) <= val (need + q + lit c_tiny)%D).
  { rewrite Ee. apply rnd_add_lower; [apply val_format| |lra]. rewrite <- (proj2 (lit_correct c_tiny eq_refl)). apply
    val_format. }
  apply Rabs_le_inv in Ea. apply Rabs_le_inv in Eb. apply Rabs_le_inv in Eab'.
  replace (val reach * (1 + 3 * u) * U) with (val reach * U * (1 + 3 * u)) by ring.
  set (ru := val reach * U) in *. rewrite TE in *.
  assert (Z1 : 21 / 10 * u * Rabs (val a) + 21 / 10 * u * Rabs (val b) = 21 / 10 * u * T) by (unfold T; ring).
  clear - EP G PT Ea Eb Eab' Need T1 Q1 Q2 Q4 RU Z1. unfold u in *. lra.
Qed.

(** ** Representatives and rectangles *)

(** P: the doubles; p: the representatives; L: bounds the distance from the double to the rectangle, for all but a few. *)
Definition off_by (P p : point) (delta : R) : Prop := Rabs (fst p - fst P) <= delta /\ Rabs (snd p - snd P) <= delta.

Lemma off_by_dist P p delta : 0 <= delta -> off_by P p delta -> dist P p <= 1415 / 1000 * delta.
Proof.
  intros D [X Y]. apply le_of_squares; [lra|]. rewrite dist_sq. unfold dist2.
  assert (S : forall x, Rabs x <= delta -> x * x <= delta * delta).
  { intros x H. replace (x * x) with (Rabs x * Rabs x) by (rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
    apply Rmult_le_compat; try apply Rabs_pos; exact H. }
  pose proof (S _ X). pose proof (S _ Y). assert (0 <= delta * delta) by apply Rle_0_sqr. lra.
Qed.

Section Star.
Variable N : nat.
Variable B : sites.
Variable x y : nat -> double.
Variable p : nat -> point.
Variable delta L : R.
Let P k : point := (val (x k), val (y k)).
Variable fat : nat -> Prop.
Variable coordinates : forall k, (k < N)%nat -> finite (x k) /\ finite (y k).
Variable delta_pos : 0 <= delta.
Variable L_pos : 0 <= L.
Variable near_doubles : forall k, (k < N)%nat -> off_by (P k) (p k) delta.
Variable radii : forall k, (k < N)%nat -> ~ fat k -> dl (P k) (B k) <= L.
Variable reach : double.
Variable reach_nneg : nneg reach.
Variable reach_least : 9 / 10 ^ 302 <= val reach.
Variable reach_most : 2 * (L + 3 * delta) <= val reach * (1 + 3 * u).

Lemma from_double k z : (k < N)%nat -> ~ fat k -> inside z (B k) -> dist (P k) z <= L.
Proof. intros K F Z. apply Rle_trans with (2 := radii k K F). now apply le_dl. Qed.

(** The vertices in a disc about c that holds i and j are connected in the skeleton: if no neighbour of i or of j is in
    it, no other vertex is. *)
Definition spreads (i j : nat) (c : point) (neighbour : nat -> Prop) : Prop :=
  forall r, dist c (p i) <= r -> dist c (p j) <= r ->
    (forall k, (k < N)%nat -> neighbour k -> k <> i -> k <> j -> r < dist c (p k)) ->
    forall k, (k < N)%nat -> k <> i -> k <> j -> r < dist c (p k).

Theorem star_edge_witness i j cx cy (b : nat -> bbox) neighbour : (i < N)%nat -> (j < N)%nat -> ~ fat i -> ~ fat j ->
  let c := (val cx, val cy) in let limit := star_limit (star_wide (x i) (y i) (x j) (y j) cx cy reach) in
  spreads i j c neighbour ->
  (forall k, (k < N)%nat -> neighbour k -> k <> i -> k <> j -> surely_farther (x k) (y k) cx cy limit = true) ->
  (forall k, (k < N)%nat -> fat k -> outward (b k) (B k) /\ (k <> i -> k <> j ->
    gt (ds2_lower (point_box cx cy) (b k)) limit = true)) ->
  (forall k, fat k \/ ~ fat k) ->
  witness N B i j c.
Proof.
  intros I J Fi Fj c limit S Near Fats Dec k K Di Dj.
  destruct (coordinates i I) as [Fxi Fyi]. destruct (coordinates j J) as [Fxj Fyj].
  pose proof (off_by_dist _ _ _ delta_pos (near_doubles i I)) as Oi. pose proof (off_by_dist _ _ _ delta_pos (near_doubles j
    J)) as Oj.
  assert (Li : dl c (B i) <= dist c (P i) + L).
  { pose proof (dist_triangle c (P i) (farthest c (B i))). pose proof (from_double i _ I Fi (farthest_inside c (B i))).
    unfold dl. lra. }
  assert (Lj : dl c (B j) <= dist c (P j) + L).
  { pose proof (dist_triangle c (P j) (farthest c (B j))). pose proof (from_double j _ J Fj (farthest_inside c (B j))).
    unfold dl. lra. }
  destruct (Dec k) as [Fk|Fk].
  - destruct (Fats k K Fk) as [O G]. specialize (G Di Dj).
    destruct (fat_farther_correct _ _ _ _ cx cy reach (b k) (B k) Fxi Fyi Fxj Fyj reach_nneg reach_least O G) as [H1 H2].
    fold c in H1, H2. fold (P i) in H1. fold (P j) in H2. lra.
  - set (r := Rmax (dist c (P i)) (dist c (P j)) + 2 * (L + 3 * delta) - 1415 / 1000 * delta).
    pose proof (Rmax_l (dist c (P i)) (dist c (P j))) as Mi. pose proof (Rmax_r (dist c (P i)) (dist c (P j))) as Mj.
    assert (R : r < dist c (p k)).
    { apply S; try assumption.
      - pose proof (dist_triangle c (P i) (p i)). unfold r. lra.
      - pose proof (dist_triangle c (P j) (p j)). unfold r. lra.
      - intros w W Nw Wi Wj. destruct (coordinates w W) as [Fxw Fyw].
        destruct (surely_farther_correct _ _ _ _ _ _ cx cy reach Fxi Fyi Fxj Fyj Fxw Fyw reach_nneg reach_least
          (Near w W Nw Wi Wj)) as [H1 H2].
        fold c in H1, H2. fold (P i) (P w) in H1. fold (P j) (P w) in H2.
        pose proof (off_by_dist _ _ _ delta_pos (near_doubles w W)) as Ow. rewrite dist_sym in Ow.
        pose proof (dist_triangle c (p w) (P w)). unfold r, Rmax. destruct (Rle_dec _ _); lra. }
    pose proof (off_by_dist _ _ _ delta_pos (near_doubles k K)) as Ok.
    pose proof (dist_triangle c (P k) (p k)) as T1. pose proof (dist_triangle c (nearest c (B k)) (P k)) as T2.
    pose proof (from_double k _ K Fk (nearest_inside c (B k))) as Lk. rewrite dist_sym in Lk.
    unfold ds. unfold r in R. split; lra.
Qed.

(** Along u, v is farther than all by m when it is farther than its neighbours by m: x lies beyond an edge of the triangle
    at v towards it. *)
Definition along_of (U z : point) : R := fst U * fst z + snd U * snd z.
Definition spreads_hull (v : nat) (U : point) (neighbour : nat -> Prop) : Prop :=
  forall m, 0 <= m -> (forall k, (k < N)%nat -> neighbour k -> k <> v -> m < along_of U (p v) - along_of U (p k)) ->
    forall k, (k < N)%nat -> k <> v -> m < along_of U (p v) - along_of U (p k).

Lemma along_dist U a b : Rabs (along_of U a - along_of U b) <= length (fst U) (snd U) * dist a b.
Proof.
  apply abs_of_sqr; [apply Rmult_le_pos; [apply sqrt_pos|apply dist_nonneg]|].
  replace (length (fst U) (snd U) * dist a b * (length (fst U) (snd U) * dist a b)) with
    (length (fst U) (snd U) * length (fst U) (snd U) * (dist a b * dist a b)) by ring.
  unfold length. rewrite sqrt_sqrt, dist_sq by (generalize (Rle_0_sqr (fst U)) (Rle_0_sqr (snd U)); unfold Rsqr; lra).
  unfold along_of, dist2. generalize (Rle_0_sqr (fst U * (snd a - snd b) - snd U * (fst a - fst b))); unfold Rsqr. lra.
Qed.

Theorem star_hull_farthest v ux uy neighbour : (v < N)%nat -> (forall k, (k < N)%nat -> ~ fat k) ->
  let U := (val ux, val uy) in
  spreads_hull v U neighbour -> 0 < length (val ux) (val uy) ->
  (forall k, (k < N)%nat -> neighbour k -> k <> v -> surely_lower ux uy (x v) (y v) (x k) (y k) reach = true) ->
  forall k z w, (k < N)%nat -> k <> v -> inside z (B k) -> inside w (B v) -> along_of U z < along_of U w.
Proof.
  intros V Nofat U S PU Near k z w K Dk Zk Wv. set (l := length (val ux) (val uy)) in *.
  set (e := 1415 / 1000 * delta).
  assert (off : forall q t, (q < N)%nat -> inside t (B q) -> Rabs (along_of U (p q) - along_of U t) <= l * (L + e)).
  { intros q t Q T. apply Rle_trans with (1 := along_dist U (p q) t). apply Rmult_le_compat_l; [apply sqrt_pos|].
    pose proof (dist_triangle (p q) (P q) t) as H. rewrite (dist_sym (p q) (P q)) in H.
    pose proof (off_by_dist _ _ _ delta_pos (near_doubles q Q)). pose proof (from_double q t Q (Nofat q Q) T).
    unfold e. lra. }
  assert (M : l * (2 * (L + 3 * delta) - 2 * e) < along_of U (p v) - along_of U (p k)).
  { apply S; try assumption.
    - apply Rmult_le_pos; [lra|unfold e; lra].
    - intros q Q Nq Dq. destruct (surely_lower_correct _ _ _ _ _ _ _ reach_nneg (Near q Q Nq Dq)) as (_ & _ & _ & _ & H).
      fold l in H.
      assert (R : l * (2 * (L + 3 * delta)) <= val reach * (1 + 3 * u) * l).
      { rewrite Rmult_comm. apply Rmult_le_compat_r; [lra|exact reach_most]. }
      pose proof (along_dist U (P v) (p v)) as A1. pose proof (along_dist U (P q) (p q)) as A2.
      change (length (fst U) (snd U)) with l in A1, A2.
      assert (B1 : l * dist (P v) (p v) <= l * e) by (apply Rmult_le_compat_l; [lra|apply off_by_dist; [exact
        delta_pos|now apply near_doubles]]).
      assert (B2 : l * dist (P q) (p q) <= l * e) by (apply Rmult_le_compat_l; [lra|apply off_by_dist; [exact
        delta_pos|now apply near_doubles]]).
      apply Rabs_le_inv in A1. apply Rabs_le_inv in A2.
      assert (E : along_of U (P v) - along_of U (P q) = val ux * (val (x v) - val (x q)) + val uy * (val (y v) - val (y q)))
        by (unfold along_of, U, P; cbn [fst snd]; ring).
      lra. }
  pose proof (off v w V Wv) as O1. pose proof (off k z K Zk) as O2. apply Rabs_le_inv in O1. apply Rabs_le_inv in O2.
  assert (0 <= l * (L + e)) by (apply Rmult_le_pos; unfold e; lra).
  assert (l * delta * (6 - 4 * (1415 / 1000)) >= 0) by (apply Rle_ge, Rmult_le_pos; [apply Rmult_le_pos|]; lra).
  unfold e in *. lra.
Qed.
End Star.
