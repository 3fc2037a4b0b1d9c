(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When the checker finds the plane of centres covered, every pair that is not listed is illegal. A centre is a triple
   (X, Y, W): the point (X/W, Y/W), or for W = 0 the point at infinity in direction (X,Y). In these a site that is surely
   nearer than another one is so on a convex cone. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Crossing.
From Dyadel Require Import Checker CheckerSound CheckerFaces CheckerComplete CheckerCover.
Import ListNotations.
Open Scope R_scope.

(* ---- centres as triples ---- *)

Record triple : Type := Triple { tx : R; ty : R; tw : R }.

Definition of_spot (g : spot) : triple := Triple (IZR (sx g)) (IZR (sy g)) (IZR (sw g)).

(* Grows with the distance of x from the centre: W times its square, but for a term that does not depend on x. *)
Definition level (z : triple) (x : point) : R := tw z * (fst x * fst x + snd x * snd x) - 2 * (tx z * fst x + ty z * snd x).

(* Every point of A is nearer to the centre than every one of C. Points are in units of 1 / S. *)
Definition beats (S : R) (z : triple) (A C : rect) : Prop :=
  forall x y, inside x A -> inside y C -> level z (S * fst x, S * snd x) < level z (S * fst y, S * snd y).

Definition combined (u v w : R) (a b c : triple) : triple :=
  Triple (u * tx a + v * tx b + w * tx c) (u * ty a + v * ty b + w * ty c) (u * tw a + v * tw b + w * tw c).

Definition in_triangle (z a b c : triple) : Prop :=
  exists u v w, 0 <= u /\ 0 <= v /\ 0 <= w /\ 0 < u + v + w /\ z = combined u v w a b c.

Theorem beats_convex S a b c z A C : beats S a A C -> beats S b A C -> beats S c A C -> in_triangle z a b c -> beats S z A C.
Proof.
  intros Ha Hb Hc (u & v & w & U & V & W & P & ->) x y X Y.
  specialize (Ha x y X Y). specialize (Hb x y X Y). specialize (Hc x y X Y).
  set (x' := (S * fst x, S * snd x)) in *. set (y' := (S * fst y, S * snd y)) in *.
  assert (L : forall t, level (combined u v w a b c) t = u * level a t + v * level b t + w * level c t)
    by (intros; unfold level, combined; simpl; ring).
  rewrite !L.
  assert (U' : u * level a x' <= u * level a y') by (apply Rmult_le_compat_l; lra).
  assert (V' : v * level b x' <= v * level b y') by (apply Rmult_le_compat_l; lra).
  assert (W' : w * level c x' <= w * level c y') by (apply Rmult_le_compat_l; lra).
  destruct (Rle_lt_dec u 0) as [U0 | U0]; [destruct (Rle_lt_dec v 0) as [V0 | V0] |].
  - assert (w * level c x' < w * level c y') by (apply Rmult_lt_compat_l; lra). lra.
  - assert (v * level b x' < v * level b y') by (apply Rmult_lt_compat_l; lra). lra.
  - assert (u * level a x' < u * level a y') by (apply Rmult_lt_compat_l; lra). lra.
Qed.

(* ---- centres that are possible ---- *)

(* The centre is possibly nearest to site i. *)
Definition allows (N : nat) (S : R) (B : sites) (z : triple) (i : nat) : Prop :=
  forall k, (k < N)%nat -> ~ beats S z (B k) (B i).

Definition is_centre (z : triple) : Prop := tw z = 1 \/ (tw z = 0 /\ (tx z <> 0 \/ ty z <> 0)).

Lemma nearer_dist S z x y : 0 < S -> tw z = 1 ->
  level z (S * fst x, S * snd x) < level z (S * fst y, S * snd y) <->
  dist (tx z / S, ty z / S) x < dist (tx z / S, ty z / S) y.
Proof.
  intros P W. rewrite dist_lt. unfold level, dist2. simpl. rewrite W.
  assert (Q : forall t : point, 1 * (S * fst t * (S * fst t) + S * snd t * (S * snd t)) - 2 * (tx z * (S * fst t) + ty z * (S * snd t))
    = S * S * ((tx z / S - fst t) * (tx z / S - fst t) + (ty z / S - snd t) * (ty z / S - snd t)) - (tx z * tx z + ty z * ty z))
    by (intros; field; lra).
  rewrite !Q. assert (V : 0 < S * S) by nra. split; intros H.
  - apply (Rmult_lt_reg_l (S * S)); [exact V | lra].
  - apply (Rmult_lt_compat_l (S * S)) in H; [lra | exact V].
Qed.

Lemma finite_allows N S B c i : 0 < S -> pos N B i c -> allows N S B (Triple (S * fst c) (S * snd c) 1) i.
Proof.
  intros P H k K F. specialize (H k K).
  pose proof (F _ _ (farthest_inside c (B k)) (nearest_inside c (B i))) as G. apply nearer_dist in G; [| exact P | reflexivity].
  simpl in G. replace (S * fst c / S, S * snd c / S) with c in G by (destruct c; simpl; f_equal; field; lra).
  unfold ds, dl in H. lra.
Qed.

Lemma far_allows N S B u i : 0 < S ->
  (forall k, (k < N)%nat -> dot u (lowest u (B k)) <= dot u (highest u (B i))) ->
  allows N S B (Triple (fst u) (snd u) 0) i.
Proof.
  intros P H k K F. specialize (H k K).
  pose proof (F _ _ (proj1 (lowest_spec u (B k))) (proj1 (highest_spec u (B i)))) as G.
  apply (Rmult_le_compat_l S) in H; [| lra]. unfold level in G. cbn [tx ty tw fst snd] in G. unfold dot in H. lra.
Qed.

Theorem possible_centre N S B i j : 0 < S -> (i < N)%nat -> (j < N)%nat -> possible N B i j ->
  exists z, is_centre z /\ allows N S B z i /\ allows N S B z j.
Proof.
  intros P I J [H | [u [U H]]].
  - apply (pair_possible N B i j I J) in H. destruct H as [c H].
    exists (Triple (S * fst c) (S * snd c) 1). split; [now left |].
    split; apply finite_allows; try exact P; apply H; try assumption; [now left | now right].
  - exists (Triple (fst u) (snd u) 0). split; [right; split; [reflexivity |] |].
    + simpl. destruct (Req_dec (fst u) 0) as [X | X]; [| now left]. right. intros Y. apply U.
      destruct u. simpl in *. congruence.
    + split; apply far_allows; try exact P; intros k K; apply (H _ k); try assumption; [now left | now right].
Qed.

(* ---- triangles that are cut ---- *)

Lemma cut_covers s t d z a b c m : 0 < s -> 0 < t -> 0 < d ->
  d * tx m = s * tx a + t * tx b -> d * ty m = s * ty a + t * ty b -> d * tw m = s * tw a + t * tw b ->
  in_triangle z a b c -> in_triangle z a m c \/ in_triangle z m b c.
Proof.
  intros S T D X Y W (u & v & w & U & V & W0 & P & ->).
  assert (E1 : tx m = (s * tx a + t * tx b) / d) by (apply (Rmult_eq_reg_l d); [rewrite X; field |]; lra).
  assert (E2 : ty m = (s * ty a + t * ty b) / d) by (apply (Rmult_eq_reg_l d); [rewrite Y; field |]; lra).
  assert (E3 : tw m = (s * tw a + t * tw b) / d) by (apply (Rmult_eq_reg_l d); [rewrite W; field |]; lra).
  destruct (Rle_dec (v * s) (u * t)) as [L | L]; [left | right].
  - assert (N1 : 0 <= v * d / t) by (apply Rle_mult_inv_pos; nra).
    assert (N2 : v * s / t <= u).
    { apply (Rmult_le_reg_r t); [exact T |]. replace (v * s / t * t) with (v * s) by (field; lra). exact L. }
    exists (u - v * s / t), (v * d / t), w. repeat split; try assumption; try lra.
    + destruct (Rle_lt_dec v 0) as [Q | Q]; [assert (v = 0) by lra; subst v; unfold Rdiv; rewrite !Rmult_0_l in *; lra |].
      assert (0 < v * d / t) by (apply Rdiv_lt_0_compat; nra). lra.
    + unfold combined. rewrite E1, E2, E3. f_equal; field; lra.
  - assert (N1 : 0 <= u * d / s) by (apply Rle_mult_inv_pos; nra).
    assert (N2 : u * t / s <= v).
    { apply (Rmult_le_reg_r s); [exact S |]. replace (u * t / s * s) with (u * t) by (field; lra). lra. }
    exists (u * d / s), (v - u * t / s), w. repeat split; try assumption; try lra.
    + destruct (Rle_lt_dec u 0) as [Q | Q]; [assert (u = 0) by lra; subst u; unfold Rdiv; rewrite !Rmult_0_l in *; lra |].
      assert (0 < u * d / s) by (apply Rdiv_lt_0_compat; nra). lra.
    + unfold combined. rewrite E1, E2, E3. f_equal; field; lra.
Qed.

Lemma triangle_turned z a b c : in_triangle z a b c -> in_triangle z b c a.
Proof.
  intros (u & v & w & U & V & W & P & ->). exists v, w, u. repeat split; try assumption; try lra.
  unfold combined. f_equal; ring.
Qed.

Lemma cuts_sound h a b c z : cuts h a b = true -> in_triangle z (of_spot a) (of_spot b) (of_spot c) ->
  (0 <= sw (middle h))%Z /\
  (in_triangle z (of_spot a) (of_spot (middle h)) (of_spot c) \/ in_triangle z (of_spot (middle h)) (of_spot b) (of_spot c)).
Proof.
  unfold cuts. rewrite !andb_true_iff, !Z.ltb_lt, Z.leb_le, !Z.eqb_eq.
  intros [[[[[[S T] D] W0] X] Y] W] H. split; [exact W0 |].
  apply (f_equal IZR) in X, Y, W. rewrite plus_IZR, !mult_IZR in X, Y, W.
  apply (cut_covers (IZR (weight h)) (IZR (other_weight h)) (IZR (divisor h))); try (now apply IZR_lt); assumption.
Qed.

(* The four quarters around a point cover all. *)
Lemma quarters_cover z o : 0 < tw o -> is_centre z ->
  let east := Triple 1 0 0 in let north := Triple 0 1 0 in let west := Triple (-1) 0 0 in let south := Triple 0 (-1) 0 in
  in_triangle z o east north \/ in_triangle z o north west \/ in_triangle z o west south \/ in_triangle z o south east.
Proof.
  intros P C. destruct z as [X Y W]. unfold is_centre in C. simpl in C. cbv zeta.
  set (q := W / tw o). assert (Q : q * tw o = W) by (unfold q; field; lra).
  assert (Q0 : 0 <= q) by (unfold q; apply Rle_mult_inv_pos; [destruct C as [-> | [-> _]]; lra | exact P]).
  set (x := X - q * tx o). set (y := Y - q * ty o).
  assert (G : 0 < q + (Rabs x + Rabs y)).
  { pose proof (Rabs_pos x). pose proof (Rabs_pos y). destruct C as [-> | [-> C]].
    - assert (0 < q) by (unfold q; apply Rdiv_lt_0_compat; lra). lra.
    - assert (q = 0) by (unfold q, Rdiv; ring). unfold x, y. rewrite H1.
      replace (X - 0 * tx o) with X by ring. replace (Y - 0 * ty o) with Y by ring.
      destruct C as [C | C]; apply Rabs_pos_lt in C; pose proof (Rabs_pos X); pose proof (Rabs_pos Y); lra. }
  destruct (Rle_dec 0 x) as [A | A], (Rle_dec 0 y) as [F | F].
  - left. exists q, x, y. rewrite Rabs_pos_eq in G by lra. rewrite Rabs_pos_eq in G by lra. repeat split; try lra.
    unfold combined, x, y. simpl. f_equal; lra.
  - right. right. right. exists q, (- y), x. rewrite Rabs_pos_eq, Rabs_left in G by lra. repeat split; try lra.
    unfold combined, x, y. simpl. f_equal; lra.
  - right. left. exists q, y, (- x). rewrite Rabs_left, Rabs_pos_eq in G by lra. repeat split; try lra.
    unfold combined, x, y. simpl. f_equal; lra.
  - right. right. left. exists q, (- x), (- y). rewrite !Rabs_left in G by lra. repeat split; try lra.
    unfold combined, x, y. simpl. f_equal; lra.
Qed.

(* ---- integers ---- *)

(* The box is around the rectangle, in units of 1 / S. *)
Definition bounds (S : R) (b : box) (A : rect) : Prop :=
  forall x, inside x A -> IZR (x0 b) <= S * fst x <= IZR (x1 b) /\ IZR (y0 b) <= S * snd x <= IZR (y1 b).

Lemma times_value w z : times w z = (w * z)%Z.
Proof. unfold times. destruct (Z.eqb_spec w 1); [subst; ring | reflexivity]. Qed.

Lemma reach_bound lo hi t w (s : R) : (0 < w)%Z -> IZR lo <= s <= IZR hi ->
  (IZR t - IZR w * s) * (IZR t - IZR w * s) <= IZR (reach (w * lo) (w * hi) t * reach (w * lo) (w * hi) t).
Proof.
  intros W [L H]. apply IZR_lt in W. rewrite mult_IZR. unfold reach. apply square_le. left.
  assert (A : IZR t - IZR w * s <= IZR (t - w * lo)) by (rewrite minus_IZR, mult_IZR; nra).
  assert (C : IZR w * s - IZR t <= IZR (w * hi - t)) by (rewrite minus_IZR, mult_IZR; nra).
  destruct (Z.max_spec (t - w * lo) (w * hi - t)) as [[M ->] | [M ->]]; [apply IZR_lt in M | apply IZR_le in M]; lra.
Qed.

Lemma gap_bound lo hi t w (s : R) : (0 < w)%Z -> IZR lo <= s <= IZR hi ->
  IZR (gap (w * lo) (w * hi) t * gap (w * lo) (w * hi) t) <= (IZR t - IZR w * s) * (IZR t - IZR w * s).
Proof.
  intros W [L H]. apply IZR_lt in W. rewrite mult_IZR. unfold gap.
  destruct (Z.ltb_spec t (w * lo)) as [A | A]; [| destruct (Z.ltb_spec (w * hi) t) as [C | C]].
  - apply IZR_lt in A. rewrite minus_IZR. rewrite mult_IZR in *. apply square_le. right. nra.
  - apply IZR_lt in C. rewrite minus_IZR. rewrite mult_IZR in *. apply square_le. left. nra.
  - rewrite Rmult_0_l. apply Rle_0_sqr.
Qed.

Lemma end_bound u lo hi (t : R) : IZR lo <= t <= IZR hi ->
  IZR (if (0 <=? u)%Z then u * lo else u * hi) <= IZR u * t <= IZR (if (0 <=? u)%Z then u * hi else u * lo).
Proof.
  intros H. destruct (Z.leb_spec 0 u) as [U | U]; rewrite !mult_IZR; [apply IZR_le in U | apply IZR_lt in U]; split; nra.
Qed.

(* far and near bound w times the level, but for a constant. *)
Lemma far_bound S g b A x : (0 < sw g)%Z -> bounds S b A -> inside x A ->
  IZR (sw g) * level (of_spot g) (S * fst x, S * snd x) + IZR (sx g) * IZR (sx g) + IZR (sy g) * IZR (sy g) <= IZR (far g b).
Proof.
  intros W H X. destruct (H x X) as [Hx Hy]. unfold far. cbv zeta. apply Z.ltb_lt in W. rewrite W. apply Z.ltb_lt in W.
  rewrite !times_value, plus_IZR. pose proof (reach_bound _ _ (sx g) _ _ W Hx). pose proof (reach_bound _ _ (sy g) _ _ W Hy).
  unfold level, of_spot. simpl. lra.
Qed.

Lemma near_bound S g b A x : (0 < sw g)%Z -> bounds S b A -> inside x A ->
  IZR (near g b) <= IZR (sw g) * level (of_spot g) (S * fst x, S * snd x) + IZR (sx g) * IZR (sx g) + IZR (sy g) * IZR (sy g).
Proof.
  intros W H X. destruct (H x X) as [Hx Hy]. unfold near. cbv zeta. apply Z.ltb_lt in W. rewrite W. apply Z.ltb_lt in W.
  rewrite !times_value, plus_IZR. pose proof (gap_bound _ _ (sx g) _ _ W Hx). pose proof (gap_bound _ _ (sy g) _ _ W Hy).
  unfold level, of_spot. simpl. lra.
Qed.

Lemma spot_beats S g k i K I : (0 <= sw g)%Z -> bounds S k K -> bounds S i I -> (far g k < near g i)%Z ->
  beats S (of_spot g) K I.
Proof.
  intros W Hk Hi H x y X Y. apply IZR_lt in H. destruct (Z.eq_dec (sw g) 0) as [Z0 | Z0].
  - unfold far, near in H. rewrite Z0 in H. simpl in H. rewrite !opp_IZR in H. unfold bottom, top in H. rewrite !plus_IZR in H.
    destruct (Hk x X) as [Kx Ky]. destruct (Hi y Y) as [Ix Iy].
    pose proof (end_bound (sx g) _ _ _ Kx). pose proof (end_bound (sy g) _ _ _ Ky).
    pose proof (end_bound (sx g) _ _ _ Ix). pose proof (end_bound (sy g) _ _ _ Iy).
    unfold level, of_spot. simpl. rewrite Z0. lra.
  - assert (P : (0 < sw g)%Z) by lia. pose proof (far_bound S g k K x P Hk X). pose proof (near_bound S g i I y P Hi Y).
    apply IZR_lt in P. nra.
Qed.

(* ---- candidates ---- *)

Section Region.
Variables (N : nat) (S : R) (B : sites) (place : Z -> nat) (whole : list candidate).
Variable here : forall p, In p whole ->
  (place (box_name (area p)) < N)%nat /\ bounds S (area p) (B (place (box_name (area p)))).

Notation site_of p := (place (box_name (area p))).
Notation allowed z p := (allows N S B z (site_of p)).

Lemma nearest_of_in g l k : In k l -> In (nearest_of g l k) l.
Proof.
  unfold nearest_of. generalize (far g (area k)). set (step := fun best i => _).
  assert (G : forall m best, In (fst (fold_left step m best)) (fst best :: m)).
  { induction m as [| i m IH]; intros best; [now left |]. simpl. destruct (IH (step best i)) as [E | I]; [| right; now right].
    rewrite <- E. unfold step. cbv zeta. destruct (_ <? _)%Z; [right; now left | now left]. }
  intros f H. destruct (G l (k, f)) as [<- | I]; assumption.
Qed.

Lemma blocked_sound a b c q i : is_blocked a b c q i = true ->
  exists k, In k q /\ (far_a k < near a (area i) /\ far_b k < near b (area i) /\ far_c k < near c (area i))%Z.
Proof.
  unfold is_blocked. cbv zeta. destruct (kept _ q) as [| k0 some] eqn:Q; [discriminate |].
  destruct (kept _ (k0 :: some)) as [| k1 some'] eqn:Q'; [discriminate |]. rewrite existsb_exists. intros [k [I C]].
  rewrite <- Q' in I. apply kept_in in I. destruct I as [I Hb]. rewrite <- Q in I. apply kept_in in I. destruct I as [I Ha].
  exists k. rewrite Z.ltb_lt in *. tauto.
Qed.

Lemma remaining_incl a b c l : incl (remaining a b c l) l.
Proof.
  unfold remaining. destruct l as [| k l]; [easy |]. cbv zeta. intros p H. now apply kept_in in H.
Qed.

Lemma remaining_keeps a b c l z p : (0 <= sw a /\ 0 <= sw b /\ 0 <= sw c)%Z -> incl l whole ->
  in_triangle z (of_spot a) (of_spot b) (of_spot c) -> In p l -> allowed z p -> In p (remaining a b c l).
Proof.
  intros (Wa & Wb & Wc) L T I A. unfold remaining. destruct l as [| k l]; [destruct I |]. cbv zeta.
  apply in_kept; [exact I |]. apply negb_true_iff. apply not_true_is_false. intros F.
  apply blocked_sound in F. destruct F as (q & Q & Fa & Fb & Fc). apply in_map_iff in Q. destruct Q as (g & <- & _).
  set (n := nearest_of g (k :: l) k) in *. assert (In_n : In n whole) by (apply L, nearest_of_in; now left).
  destruct (here n In_n) as [Kn Bn]. destruct (here p (L p I)) as [_ Bp]. simpl in Fa, Fb, Fc. apply (A _ Kn).
  apply (beats_convex S (of_spot a) (of_spot b) (of_spot c)); [| | | exact T]; eapply spot_beats; eassumption.
Qed.

Lemma all_listed_sound m l p q : all_listed m l = true -> In p l -> In q l -> box_name (area p) <> box_name (area q) ->
  is_legal m (box_name (area p)) (box_name (area q)) = true.
Proof.
  induction l as [| i l IH]; [intros _ [] |]. simpl. rewrite andb_true_iff, forallb_forall. intros [F G] P Q M.
  destruct P as [-> | P], Q as [-> | Q]; [congruence | now apply F | | now apply IH].
  apply is_legal_sym. now apply F.
Qed.

Variable hint : spot -> spot -> spot -> option cutting.
Variable m : Map.t edge.

Lemma explore_sound depth : forall effort a b c l left, explore hint m depth effort a b c l = Some left ->
  (0 <= sw a /\ 0 <= sw b /\ 0 <= sw c)%Z -> incl l whole -> forall z p q,
  in_triangle z (of_spot a) (of_spot b) (of_spot c) -> In p l -> In q l -> sought p = true -> sought q = true ->
  box_name (area p) <> box_name (area q) -> allowed z p -> allowed z q ->
  is_legal m (box_name (area p)) (box_name (area q)) = true.
Proof.
  induction depth as [| depth IH]; intros effort a b c l left H W L z p q T P Q Sp Sq M Ap Aq; simpl in H;
    pose proof (remaining_keeps a b c l z p W L T P Ap) as P'; pose proof (remaining_keeps a b c l z q W L T Q Aq) as Q';
    (destruct (all_listed m (kept sought (remaining a b c l))) eqn:K;
      [apply (all_listed_sound m _ p q K); try assumption; now apply in_kept |]); [discriminate |].
  destruct (hint a b c) as [h |]; [| discriminate].
  assert (G : forall x y r, in_triangle z (of_spot x) (of_spot y) (of_spot r) -> (0 <= sw x /\ 0 <= sw y /\ 0 <= sw r)%Z ->
    (if (0 <? effort)%Z && cuts h x y
     then match explore hint m depth (effort - 1) x (middle h) r (remaining a b c l) with
          | Some left => explore hint m depth left (middle h) y r (remaining a b c l) | None => None end
     else None) = Some left -> is_legal m (box_name (area p)) (box_name (area q)) = true).
  { intros x y r T' (Wx & Wy & Wr) H'. destruct (0 <? effort)%Z; [| discriminate].
    destruct (cuts h x y) eqn:C; [| discriminate]. simpl in H'.
    destruct (cuts_sound h x y r z C T') as [Wm D]. destruct (explore _ _ _ _ x _ r _) as [e |] eqn:X; [| discriminate].
    assert (L' : incl (remaining a b c l) whole) by (eapply incl_tran; [apply remaining_incl | exact L]).
    destruct D as [D | D]; [apply (IH _ _ _ _ _ _ X) with (z := z) | apply (IH _ _ _ _ _ _ H') with (z := z)]; tauto. }
  unfold turned in H. destruct W as (Wa & Wb & Wc). destruct (side h =? 0)%Z; [| destruct (side h =? 1)%Z].
  - apply (G a b c); tauto.
  - apply (G b c a); [now apply triangle_turned | tauto | exact H].
  - apply (G c a b); [now apply triangle_turned, triangle_turned | tauto | exact H].
Qed.

Lemma explore_all_sound effort o left : explore_all hint m effort o whole = Some left -> (0 < sw o)%Z -> forall z p q,
  is_centre z -> In p whole -> In q whole -> sought p = true -> sought q = true ->
  box_name (area p) <> box_name (area q) -> allowed z p -> allowed z q ->
  is_legal m (box_name (area p)) (box_name (area q)) = true.
Proof.
  unfold explore_all. cbn [fold_left fst snd]. intros H W z p q Z0 P Q Sp Sq M Ap Aq.
  destruct (explore _ _ _ effort _ _ _ _) as [e1 |] eqn:X1; [| discriminate].
  destruct (explore _ _ _ e1 _ _ _ _) as [e2 |] eqn:X2; [| discriminate].
  destruct (explore _ _ _ e2 _ _ _ _) as [e3 |] eqn:X3; [| discriminate].
  assert (O : 0 < tw (of_spot o)) by (simpl; now apply IZR_lt).
  pose proof (explore_sound deepest) as G.
  destruct (quarters_cover z (of_spot o) O Z0) as [T | [T | [T | T]]];
    [apply (G _ _ _ _ _ _ X1) with (z := z) | apply (G _ _ _ _ _ _ X2) with (z := z) |
     apply (G _ _ _ _ _ _ X3) with (z := z) | apply (G _ _ _ _ _ _ H) with (z := z)];
    try assumption; try (simpl; lia); try apply incl_refl.
Qed.
End Region.

(* ---- coarse boxes ---- *)

Lemma shift_below z k : (0 <= k)%Z -> IZR (Z.shiftr z k) * IZR (2 ^ k) <= IZR z.
Proof.
  intros K. rewrite Z.shiftr_div_pow2 by exact K. rewrite <- mult_IZR. apply IZR_le.
  pose proof (Z.mul_div_le z (2 ^ k) (Z.pow_pos_nonneg 2 k eq_refl K)). lia.
Qed.

Lemma coarse_bounds S k b A : (0 <= k)%Z -> 0 < S -> is_box S b A -> bounds (S / IZR (2 ^ k)) (coarse k b) A.
Proof.
  intros K P (X0 & X1 & Y0 & Y1) x [X Y]. assert (Q : 0 < IZR (2 ^ k)) by (apply IZR_lt, Z.pow_pos_nonneg; lia).
  pose proof (shift_below (x0 b) k K). pose proof (shift_below (- x1 b) k K). pose proof (shift_below (y0 b) k K).
  pose proof (shift_below (- y1 b) k K). rewrite opp_IZR in *. unfold coarse. cbn [x0 x1 y0 y1]. rewrite !opp_IZR.
  assert (G : forall s z : R, s * IZR (2 ^ k) <= S * z -> s <= S / IZR (2 ^ k) * z).
  { intros s z H3. apply (Rmult_le_reg_r (IZR (2 ^ k))); [exact Q |].
    replace (S / IZR (2 ^ k) * z * IZR (2 ^ k)) with (S * z) by (field; lra). exact H3. }
  assert (G' : forall s z : R, S * z <= s * IZR (2 ^ k) -> S / IZR (2 ^ k) * z <= s).
  { intros s z H3. apply (Rmult_le_reg_r (IZR (2 ^ k))); [exact Q |].
    replace (S / IZR (2 ^ k) * z * IZR (2 ^ k)) with (S * z) by (field; lra). exact H3. }
  repeat split; (apply G || apply G'); nra.
Qed.

(* ---- the certificate ---- *)

Definition all_candidates (k : Z) (is_sought : box -> bool) (boxes : list box) : list candidate :=
  fold_left (fun l b => Candidate (coarse k b) (is_sought b) :: l) boxes [].

Lemma all_candidates_in k f boxes p :
  In p (all_candidates k f boxes) <-> exists b, In b boxes /\ p = Candidate (coarse k b) (f b).
Proof.
  unfold all_candidates.
  assert (G : forall l, In p (fold_left (fun l b => Candidate (coarse k b) (f b) :: l) boxes l) <->
    (exists b, In b boxes /\ p = Candidate (coarse k b) (f b)) \/ In p l).
  { induction boxes as [| b boxes IH]; intros l; simpl; [firstorder |]. rewrite IH. simpl. split.
    - intros [[c [I Q]] | [Q | I]]; [left; exists c; tauto | left; exists b; split; [now left | now symmetry] | now right].
    - intros [[c [[-> | I] Q]] | I]; [right; left; now symmetry | left; exists c; tauto | tauto]. }
  rewrite (G []). simpl. tauto.
Qed.

(* Pairs of two sites that are not surrounded are listed, or illegal. *)
Theorem covered_listed D E l edges listed B hint k effort o found a b i j :
  check D E l edges = true -> describes l B -> all_covered hint k effort o D E l listed found = true ->
  named l a i -> named l b j -> a <> b ->
  Map.find i (index centre found) = None -> Map.find j (index centre found) = None -> possible (length l) B a b ->
  exists e, In e listed /\ ((from e = i /\ to e = j) \/ (from e = j /\ to e = i)).
Proof.
  intros C F H A G M Ui Uj P. destruct (accepted_parts D E l edges C) as (bs & Sc & P0 & R0 & _).
  unfold all_covered in H. rewrite Sc in H. cbv zeta in H. rewrite !andb_true_iff, Z.leb_le, Z.ltb_lt in H.
  destruct H as [[K W] H]. set (f := fun c => match Map.find (box_name c) (index centre found) with Some _ => false | None => true end).
  change (match explore_all hint (map_edges listed) effort o (all_candidates k f bs) with Some _ => true | None => false end = true) in H.
  destruct (named_box D E l edges B C F bs Sc a i A) as (ba & Ta & Fa & Na & Pa).
  destruct (named_box D E l edges B C F bs Sc b j G) as (bb & Tb & Fb & Nb & Pb).
  set (S := unit D E / IZR (2 ^ k)). pose proof (unit_pos D E P0) as U.
  assert (S0 : 0 < S) by (apply Rdiv_lt_0_compat; [exact U | apply IZR_lt, Z.pow_pos_nonneg; lia]).
  assert (Here : forall p, In p (all_candidates k f bs) -> (position bs (box_name (area p)) < length l)%nat /\
    bounds S (area p) (B (position bs (box_name (area p))))).
  { intros p I. apply all_candidates_in in I. destruct I as (c & I & ->). simpl. apply In_nth_error in I. destruct I as [n I].
    pose proof (find_box_nth (-1) bs n _ c R0 I eq_refl) as Fc.
    destruct (found_named D E l edges B C F bs Sc _ _ Fc) as [_ Kc]. split; [exact Kc |].
    apply coarse_bounds; [exact K | exact U |]. now destruct (found_box D E l edges B C F bs Sc _ _ Fc). }
  destruct (found_named D E l edges B C F bs Sc i ba Fa) as [_ Ka].
  destruct (found_named D E l edges B C F bs Sc j bb Fb) as [_ Kb]. rewrite Pa in Ka. rewrite Pb in Kb.
  destruct (possible_centre (length l) S B a b S0 Ka Kb P) as (z & Z0 & Za & Zb).
  destruct (explore_all hint _ effort o _) as [left |] eqn:X; [| discriminate].
  assert (Q : is_legal (map_edges listed) i j = true).
  { rewrite <- Na, <- Nb.
    apply (explore_all_sound (length l) S B (position bs) (all_candidates k f bs) Here hint (map_edges listed) effort o left X W z
      (Candidate (coarse k ba) (f ba)) (Candidate (coarse k bb) (f bb))); try exact Z0; simpl.
    - apply all_candidates_in. exists ba. split; [exact (nth_error_In _ _ Ta) | reflexivity].
    - apply all_candidates_in. exists bb. split; [exact (nth_error_In _ _ Tb) | reflexivity].
    - unfold f. now rewrite Na, Ui.
    - unfold f. now rewrite Nb, Uj.
    - rewrite Na, Nb. intros Q. subst j. congruence.
    - rewrite Na, Pa. exact Za.
    - rewrite Nb, Pb. exact Zb. }
  now apply is_legal_sound in Q.
Qed.

(* The whole certificate: every possible pair is listed, as legal or as open. *)
Theorem covered_complete D E l edges opened B triangles corners fans hint k effort o a b i j :
  check D E l edges = true -> describes l B ->
  all_covered hint k effort o D E l (rev_append opened edges) (surrounded D E l edges triangles corners fans) = true ->
  named l a i -> named l b j -> a <> b -> possible (length l) B a b ->
  exists e, In e (rev_append opened edges) /\ ((from e = i /\ to e = j) \/ (from e = j /\ to e = i)).
Proof.
  intros C F H A G M P. set (found := surrounded D E l edges triangles corners fans) in *.
  assert (L : forall e, In e edges -> In e (rev_append opened edges)).
  { intros e I. rewrite rev_append_rev. apply in_app_iff. now right. }
  destruct (Map.find i (index centre found)) as [f |] eqn:Qi.
  { apply index_in in Qi. destruct Qi as [I <-].
    destruct (surrounded_listed D E l edges B _ _ _ f a b j C F I A G M P) as [e [Y Q]]. exists e. split; [now apply L | exact Q]. }
  destruct (Map.find j (index centre found)) as [f |] eqn:Qj.
  { apply index_in in Qj. destruct Qj as [I <-]. apply possible_sym in P.
    destruct (surrounded_listed D E l edges B _ _ _ f b a i C F I G A (not_eq_sym M) P) as [e [Y Q]].
    exists e. split; [now apply L | tauto]. }
  exact (covered_listed D E l edges _ B hint k effort o found a b i j C F H A G M Qi Qj P).
Qed.
